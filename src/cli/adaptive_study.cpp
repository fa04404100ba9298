#include "cli/adaptive_study.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/make_replays.hpp"
#include "cli/pareto_study.hpp"
#include "cli/reused_cases.hpp"
#include "cli/selection_study.hpp"
#include "report/page.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

std::unique_ptr<AdaptiveStudy> adaptive_study(const StudyPlan& plan) {
  if (const auto* question = std::get_if<DecideQuestion>(&plan.question))
    return std::make_unique<SelectionStudy>(study_of_plan(plan), *question);
  if (std::holds_alternative<OptimiseQuestion>(plan.question)) return std::make_unique<ParetoStudy>(plan);
  return nullptr;
}

int answer(AdaptiveStudy& asked, const CommonOptions& options, const BatchFlags& batch,
           const std::vector<std::string>& reuse) {
  print_warnings(asked.warnings());
  const std::string page_template = options.page_template();
  const OutputFolder folder = asked.folder(options);
  StudyRuns runs(cases_of(folder.path()), cases_to_reuse(reuse));
  RoundExecutor rounds(runs, batch, options.jobs, options.quiet);
  freeze_plan(folder.path(), asked.plan());
  const bool with_replays = asked.run_to_decision(rounds) && options.replays > 0;
  freeze_plan(folder.path(), asked.plan());
  const bool with_page = !page_template.empty() && !with_replays;
  const int exit_code = asked.report(
      folder, options, with_page ? filled_page(page_template, page_data(asked.page(rounds.timing()))) : "");
  const int of_page =
      with_replays ? add_page_with_replays(asked, folder, runs, options, page_template, rounds.timing()) : exit_done;
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  if (!runs.not_kept().empty()) complain("warning: runs are not kept: " + runs.not_kept());
  return of_page == exit_done ? exit_code : of_page;
}

int add_page_with_replays(const AdaptiveStudy& asked, const OutputFolder& folder, const StudyRuns& runs,
                          const CommonOptions& options, const std::string& page_template, const SweepTiming& timing) {
  const StudyPage page = asked.page(timing);
  return add_page_with_replays(
      folder, best_to_replay(page.answer, options.replays), runs.kept(), options,
      [&](const Replays& replays) { return filled_page(page_template, page_data(page, replays)); });
}

}  // namespace vibrosow
