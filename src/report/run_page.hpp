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

/// The page's numbers and texts as JSON that holds no "<", so that nothing in it can end the script that it stands in.
std::string run_page_data(const RunPage& page);

/// report.html: `page_template` (shipped_page) with the data and the recording in their places. Throws
/// std::invalid_argument for a template without them.
std::string run_page(const std::string& page_template, const RunPage& page);

/// What the file holds.
FileText run_page_text();

}  // namespace vibrosow
