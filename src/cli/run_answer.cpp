#include "cli/run_answer.hpp"

#include <algorithm>
#include <iterator>

#include "plan/effects.hpp"
#include "report/expected_report.hpp"
#include "report/page.hpp"
#include "report/run_page.hpp"
#include "report/run_report.hpp"

namespace vibrosow {

RunAnswer answer_of_run(const Scene& scene, const Run& run, const std::vector<std::string>& warnings,
                        const std::optional<RateKnowledge>& knowledge, const std::optional<Drill>& drill) {
  RunAnswer answer{measure_outflow(scene, run), {}, {}};
  put_first(warnings, answer.outflow);
  ExpectedWithDoubts expected = expected_of_run(scene, run, answer.outflow, knowledge);
  std::ranges::move(expected.doubts, std::back_inserter(answer.outflow.doubts));
  answer.expected = expected.rate;
  if (drill) answer.sown = drill_metrics(scene, run, answer.outflow, *drill);
  return answer;
}

std::vector<OutputFile> files_of_run(const Model& model, const Run& run, const RunAnswer& answer, CsvFormat csv,
                                     const std::string& page_template, const std::string& recording) {
  const auto& [outflow, expected, sown] = answer;
  std::vector<OutputFile> files =
      run_files(model.scene, run, outflow, effect_names(model.effects), csv, sown, expected);
  std::ranges::move(
      page_files(page_template, run_page_data({model, run, outflow, sown, sentence_of(expected)}), recording),
      std::back_inserter(files));
  return files;
}

}  // namespace vibrosow
