#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agronomy/drill.hpp"
#include "agronomy/row_metrics.hpp"
#include "outflow/outflow.hpp"
#include "plan/model.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "result/run.hpp"
#include "study/expected_rate.hpp"

namespace vibrosow {

/// What is said of one run.
struct RunAnswer {
  Outflow outflow;
  std::optional<ExpectedRate> expected;
  std::optional<DrillMetrics> sown;
};

/// `warnings`: what can hardly be meant in its scene, which are doubts of its outflow.
RunAnswer answer_of_run(const Scene& scene, const Run& run, const std::vector<std::string>& warnings,
                        const std::optional<RateKnowledge>& knowledge, const std::optional<Drill>& drill);

/// Its reports and its page, which has a `recording` where that is not empty.
std::vector<OutputFile> files_of_run(const Model& model, const Run& run, const RunAnswer& answer, CsvFormat csv,
                                     const std::string& page_template, const std::string& recording);

}  // namespace vibrosow
