#include "cli/asked_study.hpp"

#include <fmt/format.h>

#include "cli/asked_decision.hpp"
#include "cli/asked_front.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/reused_cases.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

std::unique_ptr<AskedStudy> asked_study(const StudyPlan& plan) {
  if (plan.asked.empty()) return nullptr;
  if (plan.asked.front() == AskedFront::command) return std::make_unique<AskedFront>(plan);
  return std::make_unique<AskedDecision>(plan);
}

int answer(AskedStudy& asked, const CommonOptions& options, const MakingFlags& making,
           const std::vector<std::string>& reuse) {
  print_warnings(asked.warnings());
  const std::string page_template = options.page_template();
  const OutputFolder folder = asked.folder(options);
  StudyRuns runs(cases_of(folder.path()), cases_to_reuse(reuse));
  RoundsOfRuns rounds(runs, making, options.jobs, options.quiet);
  freeze_plan(folder.path(), asked.plan());
  asked.lead(rounds);
  freeze_plan(folder.path(), asked.plan());
  const std::string page = page_template.empty() ? "" : asked.page(page_template, rounds.timing());
  const int exit_code = asked.report(folder, options, page);
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  if (!runs.not_kept().empty()) complain("warning: runs are not kept: " + runs.not_kept());
  return exit_code;
}

void read_asked(const StudyPlan& plan, CLI::App& app) {
  std::vector<std::string> words(plan.asked.rbegin(), plan.asked.rend());  // CLI11 takes them from the end
  words.pop_back();                                                        // the command
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw InputError(
        fmt::format("{}: its plan was made by another version of the program: {}", plan.study, error.what()));
  }
}

}  // namespace vibrosow
