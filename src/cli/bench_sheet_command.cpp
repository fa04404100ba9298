#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/bench_plan.hpp"
#include "calibration/bench_runs.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "cli/progress.hpp"
#include "input/input_file.hpp"
#include "plan/scene_warnings.hpp"
#include "report/bench_report.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"
#include "study/predicted_cost.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct BenchSheetOptions {
  CommonOptions common;
  BatchFlags batch;
  std::vector<std::string> fits, settings;
  std::string time = "30 min", handling = "60 s";
  int runs = 60;
};

BenchAsked asked_of(const BenchSheetOptions& command, const std::filesystem::path& seeder) {
  BenchAsked asked{.seeder = seeder, .overrides = command.common.overrides(), .keys = {}, .settings = {}};
  for (const std::string& fit : command.fits) asked.keys.push_back(parse_fitted_key(fit));
  for (const std::string& setting : command.settings) asked.settings.push_back(parse_setting(setting));
  asked.most_runs = command.runs;
  asked.random_seed = command.common.random_seed;
  return asked;
}

OutputFolder folder_of(const BenchSheetOptions& command) {
  return command.common.output_folder("bench-sheet", bench_file_texts(), "-bench");
}

/// With the same keys and changes as this page was made for.
std::string calibrate_command(const BenchSheetOptions& command, const BenchRuns& bench) {
  const std::filesystem::path table = folder_of(command).path() / "bench.csv";
  std::string text = fmt::format("vibrosow calibrate {} \"{}\"", command.common.file, table.string());
  for (const std::string& fit : command.fits) text += fmt::format(" --fit \"{}\"", fit);
  for (const std::string& set : command.common.sets) text += fmt::format(" --set \"{}\"", set);
  return text + (bench.is_draft ? " --set accuracy=draft" : "");
}

/// What was chosen so that the sheet is not dear.
std::vector<std::string> choices_of(const BenchSheetOptions& command, const BenchRuns& bench) {
  std::vector<std::string> choices;
  const auto runs = static_cast<int>(bench.design.runs.size());
  const std::string why = fmt::format("more would take over {:.0f} minutes of two cores", bench_budget / 120);
  if (bench.is_draft)
    choices.push_back(fmt::format("Its runs are of the level \"draft\", with softer seeds: {}.", why));
  if (runs < command.runs) choices.push_back(fmt::format("It is of {} runs: {}.", runs, why));
  if (!bench.left_out.empty())
    choices.push_back(
        fmt::format("{} is left as it is: {}. --try chooses another.", fmt::join(bench.left_out, ", "), why));
  return choices;
}

/// Says what the runs that are not there yet will take, and where this machine is slower than the usual one.
void tell_cost(const BenchSheetOptions& command, const BenchRuns& bench, const StudyRuns& runs) {
  std::vector<const Scene*> missing;
  for (const CalibrationRun& run : bench.design.runs)
    if (!runs.named(name_of_run(run.scene, run.random_seed))) missing.push_back(&run.scene);
  if (missing.empty()) return;
  const double seconds = predict_seconds(missing);
  if (seconds > bench_budget)
    complain(
        fmt::format("{}: its {} runs take some {} of two cores on this machine, over {:.0f} minutes; a shorter "
                    "run.duration, a section of the tray or fewer --runs take less",
                    bench.task.seeder.string(), missing.size(), duration_text(seconds / 2), bench_budget / 120));
  if (!command.common.quiet)
    print_text(wrapped(fmt::format("{} runs, some {} of CPU time", missing.size(), duration_text(seconds))));
}

int run_bench_sheet(const BenchSheetOptions& command) {
  const CommonOptions& options = command.common;
  BenchLimits limits;
  limits.time = time_option("--time", command.time);
  limits.handling = time_option("--handling", command.handling);
  const InputFile file = input_file(options.file, FileKind::seeder);
  const BenchRuns bench = affordable_bench(asked_of(command, file.path), file.files);
  const OutputFolder folder = folder_of(command);
  StudyRuns runs(cases_of(folder.path()));
  print_warnings(scene_warnings(bench.design.runs.front().scene));
  tell_cost(command, bench, runs);
  const BatchResult made = make_runs(runs, wanted_runs(bench.design), command.batch, options.jobs, options.quiet);
  if (made.batch.interrupted > 0) {
    complain(fmt::format("{} of {} runs are still to be made", made.batch.interrupted, bench.design.runs.size()));
    return exit_interrupted;
  }
  const std::optional<BenchPlan> plan = plan_bench(bench.task, bench.design, limits, runs.kept());
  if (!plan) throw InputError(fmt::format("{}: runs are missing", folder.path().string()));
  const BenchSource source{bench.task, limits, *plan, choices_of(command, bench), calibrate_command(command, bench)};
  write_then_print(
      options.quiet, [&] { folder.write(bench_files(source, options.csv)); }, [&] { print_text(bench_table(source)); });
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  return exit_done;
}

}  // namespace

void add_bench_sheet_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchSheetOptions>();
  CLI::App* command = app.add_subcommand("bench-sheet", "print a measurement plan for calibrate");
  add_common_options(*command, options->common, "seeder file (.toml)");
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* help) {
    command->add_option(name, values, help)
        ->type_name("KEY=RANGE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  repeatable("--try", options->settings,
             "a setting that can be changed, and its range: --try \"tray.motion.frequency=7 Hz..11 Hz\"; repeatable");
  repeatable("--fit", options->fits, "a value to be fitted, as for calibrate; repeatable");
  command->add_option("--time", options->time, "time at the bench in all")->type_name("TIME")->capture_default_str();
  command->add_option("--handling", options->handling, "time of each reading to set, fill and weigh")
      ->type_name("TIME")
      ->capture_default_str();
  command->add_option("--runs", options->runs, "at most")
      ->type_name("N")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_making_flags(*command, options->batch);
  add_examples(*command,
               {"vibrosow bench-sheet wheat-tray", "vibrosow bench-sheet wheat-tray --time \"20 min\" --out sheet",
                "vibrosow bench-sheet wheat-tray --try \"tray.motion.frequency=7 Hz..11 Hz\""});
  command->callback([options, &exit_code] { exit_code = run_bench_sheet(*options); });
}

}  // namespace vibrosow
