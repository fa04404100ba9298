#pragma once

#include <optional>
#include <string>

#include "agronomy/row_figures.hpp"
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
  const std::optional<DrillFigures>& drill;
  const std::string& recording;  // file of a Recording; empty: nothing to replay
};

/// The page's numbers and texts (page_text).
std::string run_page_data(const RunPage& page);

/// report.html of a run (filled_page).
std::string run_page(const std::string& page_template, const RunPage& page);

/// What the file holds.
FileText run_page_text();

}  // namespace vibrosow
