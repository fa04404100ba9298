#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <numeric>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/threads.hpp"
#include "design/kept_runs.hpp"
#include "design/sweep.hpp"
#include "input/input_file.hpp"
#include "input/key_units.hpp"
#include "plan/softness.hpp"
#include "report/sweep_report.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "storage/case_file.hpp"
#include "storage/sweep_plan.hpp"

namespace vibrosow {
namespace {

std::string with_interval(const std::optional<MeanWithInterval>& value, double unit) {
  if (!value) return "";
  const std::string mean = to_digits(value->mean / unit, 4);
  return value->half_width_95 ? fmt::format("{} +- {}", mean, to_digits(*value->half_width_95 / unit, 2)) : mean;
}

std::string mean_text(const FigureMeans& figures, std::string_view name) {
  const Figure& figure = figure_named(name);
  return with_interval(figures[figure], figure.unit_size);
}

/// "12.1 (9.3-16)", or "< 6.2" where the seeds do not resolve it.
std::string evenness_text(const FigureMeans& figures) {
  const auto text = [&](std::string_view name) {
    const Figure& figure = figure_named(name);
    return figures[figure] ? to_digits(figures[figure]->mean / figure.unit_size, 2) : "";
  };
  const std::string high = text("evenness_cv_percent_high"), cv = mean_text(figures, "evenness_cv_percent");
  if (high.empty()) return "";
  if (cv.empty()) return "< " + high;
  return fmt::format("{} ({}-{})", to_digits(figures["evenness_cv_percent"]->mean * 100, 3),
                     text("evenness_cv_percent_low"), high);
}

/// A value of a layout as a person writes it: "9 Hz".
std::string with_unit(const std::string& key, const std::string& value) {
  const auto unit = column_unit(key);
  return unit && csv_text_or_number(value).is_number ? fmt::format("{} {}", value, unit->unit) : value;
}

std::string described(const Study& study, const Layout& layout) {
  std::string text = layout.name;
  for (const std::string& key : study.keys) {
    const auto value = layout.values.find(key);
    if (value == layout.values.end() || !layout.name.empty()) continue;
    text += (text.empty() ? "" : ", ") + key.substr(key.rfind('.') + 1) + " " + with_unit(key, value->second);
  }
  return text;
}

/// What the table shows of a layout, but for its name; each column is as wide as its longest cell.
using Cells = std::array<std::string, 4>;
const Cells heads = {"g/s", "seeds/s", "raw CV", "CV, %"};

Cells cells_of(const FigureMeans& figures) {
  return {mean_text(figures, "rate_g_per_s"), mean_text(figures, "seeds_per_s"), mean_text(figures, "raw_cv_percent"),
          evenness_text(figures)};
}

/// A line of the table: a name longer than what the cells leave has lines of its own.
std::string line_of(const std::string& number, const std::string& name, const Cells& cells,
                    const std::array<std::size_t, 4>& widths) {
  const std::string label = fmt::format("{:>3} ", number);
  const std::size_t room =
      terminal_columns - label.size() - std::accumulate(widths.begin(), widths.end(), widths.size());
  const bool fits = name.size() <= room;
  std::string text = fits ? label : wrapped_beside(label, name) + std::string(label.size(), ' ');
  text += fmt::format("{:<{}}", fits ? name : "", room);
  for (std::size_t k = 0; k < cells.size(); ++k) text += fmt::format(" {:>{}}", cells[k], widths[k]);
  return text + '\n';
}

void print_remarks(const LayoutResult& of) {
  const FigureMeans& figures = of.figures;
  if (figures["tray_rate_g_per_s"])
    print_text(wrapped(fmt::format("tray, times {}: {} g/s, {} g/min, {} seeds/s", mean_text(figures, "depth_factor"),
                                   mean_text(figures, "tray_rate_g_per_s"), mean_text(figures, "tray_rate_g_per_min"),
                                   mean_text(figures, "tray_seeds_per_s")),
                       4));
  if (of.misfit_percent) print("    misfit {} %\n", with_interval(of.misfit_percent, 1));
  if (!of.reason.empty()) print_text(wrapped(of.reason, 4));
}

void print_layouts(const StudyResult& result) {
  std::vector<Cells> rows;
  std::array<std::size_t, 4> widths{};
  for (const LayoutResult& layout : result.layouts) rows.push_back(cells_of(layout.figures));
  for (std::size_t k = 0; k < widths.size(); ++k) {
    widths[k] = heads[k].size();
    for (const Cells& row : rows) widths[k] = std::max(widths[k], row[k].size());
  }
  print_text(line_of("", "layout", heads, widths));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    print_text(line_of(std::to_string(i + 1), described(result.study, result.study.layouts[i]), rows[i], widths));
    print_remarks(result.layouts[i]);
  }
}

void print_table(const StudyResult& result) {
  print("{}\n", wrapped(result.study.title));
  print_layouts(result);
  const bool uneven = std::ranges::any_of(
      result.layouts, [](const LayoutResult& one) { return one.figures["raw_cv_percent"].has_value(); });
  if (uneven)
    print_text("\n" + wrapped("CV between the holes, %: raw, and without what counting alone gives, with its 95 % "
                              "interval; \"<\": below what this many seeds resolve"));
  if (!result.comparison) return;
  if (result.study.measured->scale == MeasuredScale::free && result.comparison->scale)
    print("\nscale fitted to the measured outflow: {:.4g}\n", *result.comparison->scale);
  if (result.comparison->misfit_percent) print("misfit over all rows: {:.3g} %\n", *result.comparison->misfit_percent);
}

int exit_code_of(const StudyResult& result, bool interrupted) {
  if (interrupted) return exit_interrupted;
  const auto stopped = std::ranges::find(result.layouts, LayoutStatus::stopped, &LayoutResult::status);
  if (stopped != result.layouts.end()) {
    complain(fmt::format("the guard stopped layout {}: {}", stopped - result.layouts.begin() + 1, stopped->reason));
    return exit_stopped_by_guard;
  }
  const bool all_invalid =
      std::ranges::all_of(result.layouts, [](const LayoutResult& one) { return one.status == LayoutStatus::invalid; });
  if (!all_invalid) return exit_done;
  complain("no layout could be simulated: " + result.layouts.front().reason);
  return exit_wrong_input;
}

struct SweepCommandOptions {
  CommonOptions common;
  std::vector<std::string> reuse;  // folders of other sweeps
};

KeptRuns kept_runs(const OutputFolder& folder, const std::vector<std::string>& reuse) {
  std::vector<std::filesystem::path> others;
  for (const std::string& other : reuse) {
    others.push_back(cases_of(other));
    if (!std::filesystem::is_directory(others.back()))
      throw InputError(fmt::format("--reuse: {} holds no runs of a sweep", other));
  }
  return {cases_of(folder.path()), others};
}

SweepPlan plan_of(const CommonOptions& options, const InputFile& file, const Study& study) {
  SweepPlan plan{std::filesystem::absolute(file.path).string(), options.sets, options.random_seed, {}};
  for (const Scene& written : study.scenes) {
    const Scene scene = at_its_accuracy(written);  // as it is run
    for (int i = 0; i < study.replicates; ++i)
      plan.runs.push_back(case_name(case_identity(scene, options.random_seed + static_cast<std::uint64_t>(i))));
  }
  return plan;
}

/// In the place of the simulator: makes no run.
Run no_run(const Model&, const SimulationOptions& options) {
  Run run;
  run.status = RunStatus::interrupted;
  run.random_seed = options.random_seed;
  return run;
}

/// Makes the reports of a study; runs that are not kept come from `simulator`.
int run_sweep(const SweepCommandOptions& sweep_command, const Simulator& simulator) {
  const CommonOptions& options = sweep_command.common;
  const InputFile file = input_file(options.file, FileKind::study);
  const Study study = read_study(file.path, options.overrides(), file.files);
  print_warnings(study_warnings(study));
  const OutputFolder folder = options.output_folder("sweep", sweep_file_texts());
  write_plan(folder.path(), plan_of(options, file, study));
  KeptRuns kept = kept_runs(folder, sweep_command.reuse);
  const int jobs = threads_to_be_had(options.jobs);
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  StudyResult result;
  double wall_time = 0;
  {
    Progress progress(options.quiet, static_cast<double>(study.scenes.size()) * study.replicates, "runs");
    SweepOptions sweep_options;
    sweep_options.first_random_seed = options.random_seed;
    sweep_options.runs.jobs = jobs;
    sweep_options.runs.interrupt = &interrupt;
    sweep_options.runs.progress = [&](const ManyRunsProgress& done) { progress.update(done.fraction_done); };
    result = sweep(study, kept.around(simulator), sweep_options);
    wall_time = progress.seconds();
  }
  write_then_print(
      options.quiet, [&] { folder.write(sweep_files(result, wall_time, jobs, options.csv)); },
      [&] { print_table(result); });
  if (!options.quiet && kept.taken() > 0) print("{} of the runs were there from before\n", kept.taken());
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  if (!kept.not_kept().empty()) complain("warning: runs are not kept: " + kept.not_kept());
  return exit_code_of(result, interrupt);
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepCommandOptions>();
  CLI::App* command =
      app.add_subcommand("sweep", "simulate every layout of a study, against measured outflow where it names some");
  add_common_options(*command, options->common, "study file (.toml)");
  command->add_option("--reuse", options->reuse, "folders of other sweeps: runs that are there are not made again")
      ->delimiter(',')
      ->type_name("FOLDER");
  command->callback([options, &exit_code] { exit_code = run_sweep(*options, run_model); });
}

void add_export_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepCommandOptions>();
  CLI::App* command =
      app.add_subcommand("export", "make a sweep's reports of the runs that are kept, simulating nothing");
  command->add_option("FOLDER", options->common.out, "of the sweep")->required();
  add_csv_option(*command, options->common);
  command->callback([options, &exit_code] {
    CommonOptions& common = options->common;
    const SweepPlan plan = read_plan(common.out);
    common.file = plan.study, common.sets = plan.sets, common.random_seed = plan.random_seed;
    exit_code = run_sweep(*options, no_run);
  });
}

}  // namespace vibrosow
