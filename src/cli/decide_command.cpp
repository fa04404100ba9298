#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/decision_text.hpp"
#include "cli/make_runs.hpp"
#include "cli/reused_cases.hpp"
#include "design/decide.hpp"
#include "design/draft_screen.hpp"
#include "design/planned_study.hpp"
#include "input/input_file.hpp"
#include "report/decision_report.hpp"
#include "storage/study_plan.hpp"

namespace vibrosow {
namespace {

struct DecideCommandOptions {
  CommonOptions common;
  MakingFlags making;
  std::vector<std::string> reuse;
  std::string goal, rate;
  std::string clogging = "5 %", within = "2 %", confidence = "95 %";
  std::string procedure = "guaranteed";
  int most = 400;
  bool drafts = false;
};

DecideOptions options_of(const DecideCommandOptions& command) {
  DecideOptions options;
  options.goal = &goal_named(command.goal);
  if (!command.rate.empty()) options.rate = read_wanted_rate(command.rate);
  options.clogging_limit = share_option("--clogging", command.clogging, 0.001, 1, "0.1 % to 100 %");
  options.margin = share_option("--within", command.within, 0.0001, 0.5, "0.01 % to 50 %");
  options.confidence = share_option("--confidence", command.confidence, 0.6, 0.9999, "60 % to 99.99 %");
  options.rule = command.procedure == "posterior" ? SelectionRule::posterior : SelectionRule::guaranteed;
  options.most = command.most;
  options.first_random_seed = command.common.random_seed;
  return options;
}

/// Tells of each layout that drops out while runs are made.
class LayoutsLeft {
 public:
  void tell(const StudyDecision& decision, std::int64_t made, bool quiet) {
    const std::size_t left = decision.left();
    if (!quiet && made > told_at_ && left != left_)
      complain(fmt::format("after {} new runs: {} layouts left", made, left));
    left_ = left;
    told_at_ = made;
  }

 private:
  std::size_t left_ = 0;
  std::int64_t told_at_ = 0;
};

/// A decision with the drafts before it, if any.
struct Asked {
  std::optional<DraftScreen> drafts;
  DecideOptions options;
};

DecisionReport decide(PlannedStudy& planned, Asked& asked, const DecideCommandOptions& command, StudyRuns& runs,
                      const OutputFolder& folder) {
  RoundsOfRuns rounds(runs, command.making, command.common.jobs, command.common.quiet);
  DecisionReport report;
  bool is_whole = true;
  if (asked.drafts) {
    is_whole = rounds.lead(*asked.drafts, [] {});
    report.drafts = asked.drafts->findings();
  }
  StudyDecision decision(planned.study, asked.options,
                         report.drafts ? report.drafts->taking_part : std::vector<bool>());
  const auto freeze = [&] {
    planned.plan.runs = decision.plan();
    freeze_plan(folder.path(), planned.plan);
  };
  decision.wanted();
  freeze();
  LayoutsLeft left;
  is_whole = is_whole && rounds.lead(decision, [&] { left.tell(decision, rounds.made(), command.common.quiet); });
  freeze();
  report.result = decision.result();
  report.result.is_interrupted = !is_whole;
  return report;
}

int run_decide(const DecideCommandOptions& command) {
  const CommonOptions& common = command.common;
  Asked asked{std::nullopt, options_of(command)};
  const InputFile file = input_file(common.file, FileKind::study);
  PlannedStudy planned = plan_study(file.path, common.sets, common.random_seed, file.files);
  print_warnings(study_warnings(planned.study));
  StudyDecision(planned.study, asked.options);  // refuses what cannot be decided before anything is written
  if (command.drafts) asked.drafts.emplace(planned.study, asked.options);
  const OutputFolder folder = common.output_folder("decide", decision_file_texts());
  StudyRuns runs(cases_of(folder.path()), cases_to_reuse(command.reuse));
  const DecisionReport report = decide(planned, asked, command, runs, folder);
  write_then_print(
      common.quiet, [&] { folder.write(decision_files(report, common.csv)); },
      [&] { print("{}", decision_text(report)); });
  if (!common.quiet) print("reports: {}\n", folder.path().string());
  if (!runs.not_kept().empty()) complain("warning: runs are not kept: " + runs.not_kept());
  return report.result.is_interrupted ? exit_interrupted : exit_done;
}

std::string names_of_goals() {
  std::string names;
  for (const Goal& goal : goals()) names += fmt::format("{}{}", names.empty() ? "" : ", ", goal.name);
  return names;
}

}  // namespace

void add_decide_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DecideCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "decide", "find the best layout of a study: runs go where they decide, until it is sure enough");
  add_common_options(*command, options->common, "study file (.toml)");
  command->add_option("--goal", options->goal, "what makes a layout good: " + names_of_goals())
      ->type_name("GOAL")
      ->required();
  command->add_option("--rate", options->rate, "wanted of the tray: \"43 seeds/s +- 5 %\", \"12 g/min +- 5 %\"")
      ->type_name("RATE");
  command->add_option("--clogging", options->clogging, "share of runs that a layout must clog less often than")
      ->type_name("SHARE")
      ->capture_default_str();
  command->add_option("--within", options->within, "a difference that does not matter, over the best's mean")
      ->type_name("SHARE")
      ->capture_default_str();
  command->add_option("--confidence", options->confidence, "of a right decision")
      ->type_name("SHARE")
      ->capture_default_str();
  command->add_option("--procedure", options->procedure, "guaranteed, or posterior: fewer runs and no guarantee")
      ->type_name("NAME")
      ->check(CLI::IsMember({"guaranteed", "posterior"}))
      ->capture_default_str();
  command->add_option("--most", options->most, "runs of a layout, at which it is given up")
      ->type_name("N")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command->add_flag("--drafts", options->drafts,
                    "let quick runs rule layouts out, if they are shown to be like the others");
  add_making_flags(*command, options->making);
  add_reuse_option(*command, options->reuse);
  command->callback([options, &exit_code] { exit_code = run_decide(*options); });
}

}  // namespace vibrosow
