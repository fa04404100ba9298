#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/bench_plan.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "input/input_file.hpp"
#include "report/bench_report.hpp"
#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct BenchSheetOptions {
  CommonOptions common;
  MakingFlags making;
  std::vector<std::string> fits, settings;
  std::string time = "30 min", handling = "60 s";
  int runs = 250;
};

CalibrationTask task_of(const BenchSheetOptions& command, const InputFile& seeder) {
  CalibrationTask task;
  task.seeder = seeder.path;
  task.overrides = command.common.overrides();
  for (const std::string& fit : command.fits) task.keys.push_back(parse_fitted_key(fit));
  if (task.keys.empty()) task.keys = usual_fitted_keys(task.seeder, task.overrides, seeder.files);
  const Scene scene = middle_scene(task, seeder.files);
  std::vector<KeyRange> settings;
  for (const std::string& setting : command.settings) settings.push_back(parse_setting(setting));
  if (settings.empty()) settings = usual_settings(scene);
  if (settings.empty())
    throw InputError(
        fmt::format("{}: the tray has no harmonic motion; say what can be set at the bench, such as --try "
                    "\"tray.holes.width=8 mm..12 mm\"",
                    task.seeder.string()));
  task.measured.file = "--try";
  task.measured.table = bench_candidates(settings);
  task.measured.scale = scene.space == Space::plane ? MeasuredScale::free : MeasuredScale::none;
  task.most_runs = command.runs;
  task.random_seed = command.common.random_seed;
  return task;
}

/// With the same keys and changes as this page was made for.
std::string calibrate_command(const BenchSheetOptions& command) {
  std::string text = fmt::format("vibrosow calibrate {} bench.csv", command.common.file);
  for (const std::string& fit : command.fits) text += fmt::format(" --fit \"{}\"", fit);
  for (const std::string& set : command.common.sets) text += fmt::format(" --set \"{}\"", set);
  return text;
}

int run_bench_sheet(const BenchSheetOptions& command) {
  const CommonOptions& options = command.common;
  BenchLimits limits;
  limits.time = time_option("--time", command.time);
  limits.handling = time_option("--handling", command.handling);
  const InputFile file = input_file(options.file, FileKind::seeder);
  const CalibrationTask task = task_of(command, file);
  const CalibrationDesign design = design_calibration(task, file.files);
  const OutputFolder folder = options.output_folder("bench-sheet", bench_file_texts(), "-bench");
  StudyRuns runs(cases_of(folder.path()));
  const Made made = make_runs(runs, wanted_runs(design), command.making, options.jobs, options.quiet);
  if (made.making.interrupted > 0) {
    complain(fmt::format("{} of {} runs are still to be made", made.making.interrupted, design.runs.size()));
    return exit_interrupted;
  }
  const std::optional<BenchPlan> plan = plan_bench(task, design, limits, runs.kept());
  if (!plan) throw InputError(fmt::format("{}: runs are missing", folder.path().string()));
  const BenchSource source{task, limits, *plan, calibrate_command(command)};
  write_then_print(
      options.quiet, [&] { folder.write(bench_files(source, options.csv)); }, [&] { print_text(bench_table(source)); });
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  return exit_done;
}

}  // namespace

void add_bench_sheet_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchSheetOptions>();
  CLI::App* command =
      app.add_subcommand("bench-sheet", "a page to print: what to measure, so that calibrate tells most from it");
  add_common_options(*command, options->common, "seeder file (.toml)");
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* help) {
    command->add_option(name, values, help)
        ->type_name("KEY=RANGE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  repeatable("--try", options->settings, "what can be set: --try \"tray.motion.frequency=7 Hz..11 Hz\"; repeatable");
  repeatable("--fit", options->fits, "what is to be fitted, as calibrate takes it; repeatable");
  command->add_option("--time", options->time, "at the bench, in all")->type_name("TIME")->capture_default_str();
  command->add_option("--handling", options->handling, "of each reading, to set, fill and weigh")
      ->type_name("TIME")
      ->capture_default_str();
  command->add_option("--runs", options->runs, "at most")
      ->type_name("N")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_making_flags(*command, options->making);
  add_examples(*command,
               {"vibrosow bench-sheet wheat-tray", "vibrosow bench-sheet wheat-tray --time \"20 min\" --out sheet",
                "vibrosow bench-sheet wheat-tray --try \"tray.motion.frequency=7 Hz..11 Hz\""});
  command->callback([options, &exit_code] { exit_code = run_bench_sheet(*options); });
}

}  // namespace vibrosow
