#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "agronomy/row_metrics.hpp"
#include "outflow/doubts.hpp"
#include "outflow/outflow.hpp"
#include "plan/model.hpp"
#include "report/columns.hpp"
#include "result/run.hpp"

namespace vibrosow {

/// What a run's page shows.
struct RunPage {
  const Model& model;
  const Run& run;
  const Outflow& outflow;
  const std::optional<DrillMetrics>& drill;
  const std::string& expected;  // the sentence on what the rate is expected to be; empty: none
};

/// What is to be said of a scene before it is run.
std::vector<Remark> remarks_about(const Scene& scene);

/// Puts what can hardly be meant in a run's scene before what speaks against its outflow.
void put_first(const std::vector<std::string>& warnings, Outflow& outflow);

/// The page's numbers and texts (page_text).
std::string run_page_data(const RunPage& page);

/// Every seed that left, as the page's numbers have it.
nlohmann::ordered_json page_events(const Run& run);

/// What the file holds.
FileText run_page_text();

}  // namespace vibrosow
