#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/threads.hpp"
#include "design/sweep.hpp"
#include "input/input_file.hpp"
#include "report/sweep_report.hpp"
#include "simulation/simulate.hpp"

namespace vibrosow {
namespace {

std::string with_interval(const std::optional<MeanWithInterval>& value, double factor) {
  if (!value) return "";
  if (!value->half_width_95) return fmt::format("{:.3g}", value->mean * factor);
  return fmt::format("{:.3g} +- {:.2g}", value->mean * factor, *value->half_width_95 * factor);
}

std::string described(const Study& study, const Layout& layout) {
  std::string text = layout.name;
  for (const std::string& key : study.keys) {
    const auto value = layout.values.find(key);
    if (value == layout.values.end() || !layout.name.empty()) continue;
    text += (text.empty() ? "" : ", ") + key.substr(key.rfind('.') + 1) + " " + value->second;
  }
  return text;
}

void print_table(const StudyResult& result) {
  print("{}\n\n{:>6} {:<36} {:>18} {:>18} {:>18} {:>14}\n", result.study.title, "layout", "", "g per s", "seeds per s",
        "evenness CV %", "misfit %");
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const LayoutResult& of = result.layouts[i];
    print("{:>6} {:<36} {:>18} {:>18} {:>18} {:>14} {}\n", i + 1, described(result.study, result.study.layouts[i]),
          with_interval(of.figures["rate_g_per_s"], 1e3), with_interval(of.figures["seeds_per_s"], 1),
          with_interval(of.figures["evenness_cv_percent"], 100), with_interval(of.misfit_percent, 1), of.reason);
  }
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

int run_sweep(const CommonOptions& options) {
  const Study study = read_study(input_file(options.file, FileKind::study), options.overrides());
  print_warnings(study_warnings(study));
  const OutputFolder folder = options.output_folder("sweep", sweep_file_texts());
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
    result = sweep(study, run_model, sweep_options);
    wall_time = progress.seconds();
  }
  write_then_print(
      options.quiet, [&] { folder.write(sweep_files(result, wall_time, jobs, options.csv)); },
      [&] { print_table(result); });
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  return exit_code_of(result, interrupt);
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command =
      app.add_subcommand("sweep", "simulate every layout of a study, against measured outflow where it names some");
  add_common_options(*command, *options, "study file (.toml)");
  command->callback([options, &exit_code] { exit_code = run_sweep(*options); });
}

}  // namespace vibrosow
