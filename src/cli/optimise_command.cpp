#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/make_runs.hpp"
#include "cli/optimise_text.hpp"
#include "cli/reused_cases.hpp"
#include "design/optimise.hpp"
#include "input/input_file.hpp"
#include "report/front_report.hpp"
#include "storage/study_plan.hpp"

namespace vibrosow {
namespace {

struct OptimiseCommandOptions {
  CommonOptions common;
  MakingFlags making;
  std::vector<std::string> reuse, goals;
  std::string rate, spilled;
  std::string clogging = "5 %", confidence = "95 %";
  int runs = 400;
};

OptimiseOptions options_of(const OptimiseCommandOptions& command) {
  OptimiseOptions options;
  options.goals = read_front_goals(command.goals);
  if (!command.rate.empty()) options.rate = read_wanted_rate(command.rate);
  options.clogging_limit = share_option("--clogging", command.clogging, 0.001, 1, "0.1 % to 100 %");
  if (!command.spilled.empty())
    options.spilled_limit = share_option("--spilled", command.spilled, 0.0001, 1, "0.01 % to 100 %");
  options.confidence = share_option("--confidence", command.confidence, 0.6, 0.9999, "60 % to 99.99 %");
  options.runs = command.runs;
  options.first_random_seed = command.common.random_seed;
  return options;
}

int run_optimise(const OptimiseCommandOptions& command) {
  const CommonOptions& common = command.common;
  const OptimiseOptions options = options_of(command);
  const InputFile file = input_file(common.file, FileKind::study);
  StudyOptimisation optimisation({file.path, common.overrides(), file.files}, options);
  print_warnings(optimisation.warnings());
  const OutputFolder folder = common.output_folder("optimise", optimise_file_texts());
  StudyRuns runs(cases_of(folder.path()), cases_to_reuse(command.reuse));
  RoundsOfRuns rounds(runs, command.making, common.jobs, common.quiet);
  const bool is_whole = rounds.lead(optimisation, [&] {
    if (!common.quiet && rounds.made() > 0)
      complain(fmt::format("after {} new runs: {} layouts tried", rounds.made(), optimisation.tried()));
  });
  OptimiseResult result = optimisation.result();
  result.is_interrupted = !is_whole;
  write_then_print(
      common.quiet, [&] { folder.write(optimise_files(result, folder.path(), common.csv)); },
      [&] { print("{}", optimise_text(result, folder.path().string())); });
  if (!common.quiet) print("reports: {}\n", folder.path().string());
  if (!runs.not_kept().empty()) complain("warning: runs are not kept: " + runs.not_kept());
  return result.is_interrupted ? exit_interrupted : exit_done;
}

std::string names_of_goals() {
  std::string names;
  for (const FrontGoal& goal : front_goals()) names += fmt::format("{}{}", names.empty() ? "" : ", ", goal.name);
  return names;
}

}  // namespace

void add_optimise_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<OptimiseCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "optimise", "look in the space of a study for layouts that no other is better than in several goals");
  add_common_options(*command, options->common, "study file (.toml)");
  command->add_option("--goals", options->goals, "what makes a layout good: " + names_of_goals())
      ->delimiter(',')
      ->type_name("GOAL")
      ->required();
  command->add_option("--rate", options->rate, "wanted of the tray: \"43 seeds/s +- 5 %\", \"12 g/min +- 5 %\"")
      ->type_name("RATE");
  command->add_option("--runs", options->runs, "that it may take")
      ->type_name("N")
      ->check(CLI::Range(8, 1000000))
      ->capture_default_str();
  command->add_option("--clogging", options->clogging, "share of a layout's runs that may clog")
      ->type_name("SHARE")
      ->capture_default_str();
  command->add_option("--spilled", options->spilled, "share of the seeds that may leave over the rim; default any")
      ->type_name("SHARE");
  command->add_option("--confidence", options->confidence, "of what is said of a layout")
      ->type_name("SHARE")
      ->capture_default_str();
  add_making_flags(*command, options->making);
  add_reuse_option(*command, options->reuse);
  command->callback([options, &exit_code] { exit_code = run_optimise(*options); });
}

}  // namespace vibrosow
