#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/calibration_answer.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "input/input_file.hpp"
#include "input/named_columns.hpp"
#include "input/read_scene.hpp"
#include "plan/scene_warnings.hpp"
#include "report/calibration_page.hpp"
#include "report/calibration_report.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct CalibrateOptions {
  CommonOptions common;
  BatchFlags batch;
  std::string table;
  std::vector<std::string> columns, fits;
  std::string scale, hold_out, noise, time_zero;
  int runs = 150;
};

MeasuredTable read_table(const CalibrateOptions& command, SourceFiles& files) {
  std::vector<ColumnName> names;
  for (const std::string& column : command.columns) names.push_back(parse_column_name(column));
  return read_measured(with_named_columns(files.csv(command.table), names));
}

MeasuredScale scale_of(const CalibrateOptions& command, const MeasuredTable& table, const Scene& scene) {
  if (command.scale == "none") return MeasuredScale::none;
  if (command.scale == "depth") return MeasuredScale::depth;
  if (command.scale == "free") return MeasuredScale::free;
  if (scene.space == Space::three_dimensional || table.quantity == MeasuredQuantity::fraction_curve)
    return MeasuredScale::none;
  return is_curve(table.quantity) ? MeasuredScale::depth : MeasuredScale::free;
}

/// "none", a whole number of conditions, or a time of curves.
HoldOut hold_out_of(const CalibrateOptions& command, const MeasuredTable& table) {
  const std::string& text = command.hold_out;
  if (text.empty()) return usual_hold_out(table);
  if (text == "none") return {};
  HoldOut hold_out;
  if (is_curve(table.quantity)) {
    hold_out.after = time_option("--hold-out", text);
    return hold_out;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hold_out.every);
  if (error != std::errc{} || end != text.data() + text.size() || hold_out.every < 2)
    throw InputError(fmt::format("--hold-out {}: expected none, or 2 or more: every so many-th condition", text));
  return hold_out;
}

std::optional<double> noise_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    if (const double noise = parse_quantity(text, Dimension::fraction, "3 %"); noise > 0 && noise <= 1) return noise;
  } catch (const UnitError& error) {
    throw InputError(fmt::format("--noise: {}", error.what()));
  }
  throw InputError(fmt::format("--noise: {} is not above 0 and up to 100 %", text));
}

CalibrationTask task_of(const CalibrateOptions& command, const InputFile& seeder) {
  CalibrationTask task;
  task.seeder = seeder.path;
  task.overrides = command.common.overrides();
  task.measured.file = command.table;
  task.measured.table = read_table(command, *seeder.files);
  if (!command.time_zero.empty())
    task.measured.time_zero = quantity_option("--time-zero", command.time_zero, Dimension::time, 0, 1e6, "2 s");
  for (const std::string& fit : command.fits) task.keys.push_back(parse_fitted_key(fit));
  if (task.keys.empty()) task.keys = usual_fitted_keys(task.seeder, task.overrides, seeder.files);
  task.measured.scale = scale_of(command, task.measured.table, middle_scene(task, seeder.files));
  task.most_runs = command.runs;
  task.random_seed = command.common.random_seed;
  return task;
}

/// The contact with the fitted means, as the seeder has it beside.
Contact fitted_contact(const CalibrationTask& task, const Calibration& calibration,
                       const std::shared_ptr<SourceFiles>& files) {
  std::vector<Override> overrides = task.overrides;
  for (std::size_t k = 0; k < task.keys.size(); ++k) {
    KeyRange fitted = task.keys[k];
    fitted.low = fitted.high = calibration.values[k].mean;
    overrides.push_back(fitted.override_at(0));
  }
  return read_scene(task.seeder, overrides, files).contact;
}

int run_calibrate(const CalibrateOptions& command) {
  const CommonOptions& options = command.common;
  const InputFile file = input_file(options.file, FileKind::seeder);
  const CalibrationTask task = task_of(command, file);
  const CalibrationChoices choices{hold_out_of(command, task.measured.table), noise_of(command.noise)};
  const CalibrationDesign design = design_calibration(task, file.files);
  print_warnings(scene_warnings(middle_scene(task, file.files)));
  const std::string page_template = options.page_template();
  const OutputFolder folder = options.output_folder("calibrate", calibration_file_texts(), "-calibration");
  StudyRuns runs(cases_of(folder.path()));
  const BatchResult made = make_runs(runs, wanted_runs(design), command.batch, options.jobs, options.quiet);
  if (made.batch.interrupted > 0) {
    complain(fmt::format("{} of {} runs are still to be made", made.batch.interrupted, design.runs.size()));
    return exit_interrupted;
  }
  const std::optional<std::vector<ReducedRun>> reduced = reduced_runs(task, design, runs.kept());
  if (!reduced) throw InputError(fmt::format("{}: runs are missing", folder.path().string()));
  const Calibration calibration = calibrate(task, design, choices, *reduced);
  const CalibrationAnswer answer = answer_of(task, design, *reduced, calibration);
  std::vector<OutputFile> files = calibration_files(answer, fitted_contact(task, calibration, file.files), options.csv);
  std::ranges::move(page_files(page_template, calibration_page_data(answer, middle_scene(task, file.files))),
                    std::back_inserter(files));
  write_then_print(
      options.quiet, [&] { folder.write(files); }, [&] { print_text(calibration_table(answer)); });
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  if (answer.is_fitted) return exit_done;
  complain(fmt::format("{}: no values within the ranges meet it: the best miss it by {:.2g} times its noise",
                       command.table, calibration.misfit_over_noise));
  return exit_wrong_input;
}

void add_fit_options(CLI::App& command, CalibrateOptions& options) {
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* help, const char* type) {
    command.add_option(name, values, help)
        ->type_name(type)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  repeatable("--column", options.columns,
             "what a column of the table holds: --column \"Menge [g/min]=rate\"; repeatable", "COLUMN=NAME");
  repeatable("--fit", options.fits,
             "a number of [contact] and its range: --fit \"contact.friction=0.2..0.8\"; repeatable", "KEY=RANGE");
  command
      .add_option("--scale", options.scale, "none, depth, or free: rates times an unknown factor; default free in 2D")
      ->type_name("SCALE")
      ->check(CLI::IsMember({"none", "depth", "free"}));
  command
      .add_option("--hold-out", options.hold_out,
                  "what to hold out and predict: every Nth condition (N), of curves all after a time, or none")
      ->type_name("PART");
  command
      .add_option("--noise", options.noise,
                  "error of one reading, such as \"3 %\"; default: from the table's repeats, else from simulated runs")
      ->type_name("SHARE");
  command.add_option("--time-zero", options.time_zero, "time of the run at which a curve's time is zero")
      ->type_name("TIME");
  command.add_option("--runs", options.runs, "at most")
      ->type_name("N")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
}

}  // namespace

void add_calibrate_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command =
      app.add_subcommand("calibrate", "fit friction, restitution and other contact values to measured outflow");
  add_common_options(*command, options->common, "seeder file (.toml)");
  command->add_option("TABLE", options->table, "measured outflow (.csv)")->required();
  add_fit_options(*command, *options);
  add_html_option(*command, options->common);
  add_making_flags(*command, options->batch);
  add_examples(*command, {"vibrosow calibrate wheat-tray measured.csv",
                          "vibrosow calibrate wheat-tray measured.csv --fit contact.friction=0.2..0.8",
                          "vibrosow calibrate wheat-tray measured.csv --runs 100 --html --out quick"});
  command->callback([options, &exit_code] { exit_code = run_calibrate(*options); });
}

}  // namespace vibrosow
