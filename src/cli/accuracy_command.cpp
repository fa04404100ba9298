#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <numeric>

#include "accuracy/accuracy.hpp"
#include "accuracy/accuracy_doubts.hpp"
#include "accuracy/promise.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/threads.hpp"
#include "input/input_file.hpp"
#include "input/read_scene.hpp"
#include "laws/law.hpp"
#include "plan/scene_warnings.hpp"
#include "plan/softness.hpp"
#include "report/accuracy_page.hpp"
#include "report/accuracy_report.hpp"
#include "report/answer_doubts.hpp"
#include "report/kept_page.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "scene/integrator_names.hpp"
#include "simulation/simulate.hpp"
#include "storage/case_folder.hpp"
#include "storage/study_plan.hpp"
#include "study/predicted_cost.hpp"
#include "study/study_runs.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct AccuracyOptions {
  CommonOptions common;
  std::vector<std::string> integrators;
  std::vector<double> steps_per_contact, shell_compressions;
  std::vector<std::string> youngs_moduli, slip_speeds;
  int replicates = 5, depth = 0;
  std::string within, budget;

  bool promises() const { return !within.empty() || !budget.empty(); }
  bool names_levels() const {
    return !(integrators.empty() && steps_per_contact.empty() && shell_compressions.empty() && youngs_moduli.empty() &&
             slip_speeds.empty());
  }
};

constexpr double least_percent = 0.01, most_percent = 50;
constexpr double least_budget = 1, most_budget = 1e7;  // s

/// CLI::Range takes nan.
CLI::Validator number_within(double least, double most) {
  return {[least, most](const std::string& text) {
            double number = 0;
            const bool within = CLI::detail::lexical_cast(text, number) && number >= least && number <= most;
            return within ? "" : fmt::format("\"{}\" is not a number from {:g} to {:g}", text, least, most);
          },
          "NUMBER"};
}

/// Each from `least` to `most` (SI).
std::vector<double> quantities(const char* option, const std::vector<std::string>& texts, Dimension dimension,
                               double least, double most) {
  std::vector<double> values;
  for (const std::string& text : texts) values.push_back(quantity_option(option, text, dimension, least, most));
  return values;
}

Integrator integrator_of(const std::string& name) {
  const auto& names = integrator_names();
  return static_cast<Integrator>(std::ranges::find(names, name) - names.begin());
}

AccuracyGrid grid_of(const AccuracyOptions& options, const Scene& scene) {
  AccuracyGrid grid = default_accuracy_grid(scene);
  if (!options.steps_per_contact.empty()) grid.steps_per_contact = options.steps_per_contact;
  const LawTraits& law = traits_of(scene.contact.law);
  const auto refuse_unless = [&](LawMaterial material, const char* option, const auto& values) {
    if (values.empty() || law.material == material) return;
    throw InputError(fmt::format("{}: {} has the law {}, whose stiffness is {}", option, options.common.file, law.name,
                                 law.stiffness_key()));
  };
  refuse_unless(LawMaterial::shell, "--shell-compression", options.shell_compressions);
  refuse_unless(LawMaterial::elastic, "--youngs-modulus", options.youngs_moduli);
  if (!options.shell_compressions.empty()) grid.shell_compressions = options.shell_compressions;
  if (!options.youngs_moduli.empty())
    grid.youngs_moduli = quantities("--youngs-modulus", options.youngs_moduli, Dimension::pressure, 1, 1e13);
  if (!options.slip_speeds.empty() && grid.slip_speeds.empty())
    throw InputError(fmt::format("--slip-speed: the friction of {} has none", options.common.file));
  if (!options.slip_speeds.empty())
    grid.slip_speeds = quantities("--slip-speed", options.slip_speeds, Dimension::speed, 1e-6, 100);
  if (!options.integrators.empty()) {
    grid.integrators.clear();
    for (const std::string& name : options.integrators) grid.integrators.push_back(integrator_of(name));
  }
  return grid;
}

AccuracyDesign design_of(const AccuracyOptions& options, const Scene& scene) {
  const AccuracyGrid grid = grid_of(options, scene);
  return options.names_levels() ? full_design(grid) : screening_design(grid);
}

/// A budget of so many jobs.
PromiseGoal goal_of(const AccuracyOptions& options, int jobs) {
  PromiseGoal goal;
  if (!options.within.empty())
    goal.within_percent = 100 * quantity_option("--within", options.within, Dimension::fraction, least_percent / 100,
                                                most_percent / 100, "3 %");
  if (!options.budget.empty())
    goal.cpu_time =
        jobs * quantity_option("--budget", options.budget, Dimension::time, least_budget, most_budget, "10 min");
  return goal;
}

/// The scene's own scheme alone: others cost more for what they bring, which the table of `accuracy` shows.
PromiseChoices choices_of(const Scene& scene) {
  AccuracyGrid grid = default_accuracy_grid(scene);
  grid.integrators = {scene.numerics.integrator};
  return {.design = runnable(scene, screening_design(grid)),
          .lead = scene.run.measure_from,
          .window = scene.run.duration - scene.run.measure_from,
          .windows = windows_alike(scene)};
}

/// CPU time, s, of the first round, by the time that a run of the scene takes.
double predicted_pilot_cost(const PromiseChoices& choices, const Scene& scene) {
  const Model model = prepare(scene);
  const double own_steps = model.step.contact_duration / model.step.dt;
  const double run = predict_cost(scene).seconds();
  double pilots = 0;
  for (std::size_t i = 0; i < choices.design.settings.size(); ++i) {
    AccuracySetting setting = choices.design.settings[i];
    if (choices.design.runs[i] == 0) continue;
    scene_with(scene, setting);
    pilots += choices.design.runs[i] * run * setting.steps_per_contact / own_steps * model.step.contact_duration /
              setting.contact_duration;
  }
  return pilots;
}

void refuse_small_budget(const PromiseGoal& goal, double pilots, int jobs) {
  if (goal.cpu_time && pilots > *goal.cpu_time)
    throw InputError(fmt::format("--budget: the pilots alone would take some {}", duration_text(pilots / jobs)));
}

/// Runs settings with a progress line of their own for each stage.
RunSettings with_progress(SettingRunner& runner, bool quiet) {
  return [&runner, quiet](const std::vector<SettingRuns>& wanted) {
    double runs = 0;
    for (const SettingRuns& of : wanted) runs += of.runs;
    Progress progress(text_unless(quiet), runs, "runs");
    runner.set_progress([&](const ManyRunsProgress& done) { progress.update(done.fraction_done); });
    std::vector<AccuracyRun> made = runner.run(wanted);
    runner.set_progress({});
    return made;
  };
}

SweepOptions sweep_options_of(const AccuracyOptions& options, int jobs, const std::atomic<bool>& interrupt) {
  SweepOptions sweep_options;
  sweep_options.first_random_seed = options.common.random_seed;
  sweep_options.runs.jobs = jobs;
  sweep_options.runs.interrupt = &interrupt;
  return sweep_options;
}

/// The scene that a command is about, its accuracy level written out, with its warnings printed.
Scene scene_of(const AccuracyOptions& options) {
  const InputFile file = input_file(options.common.file, FileKind::seeder);
  const Scene scene = read_scene(file.path, options.common.overrides(), file.files);
  print_warnings(scene_warnings(scene));
  return resolve_accuracy_level(scene);
}

void add_page(std::vector<OutputFile>& files, const std::string& page_template, const std::string& data) {
  const auto times = std::ranges::find(files, page_times_name, &OutputFile::name);
  std::ranges::move(timed_page_files(page_template, data, times->content), std::back_inserter(files));
}

int ended(const AccuracyOptions& options, const OutputFolder& folder, const StudyRuns& runs, bool interrupted) {
  if (!options.common.quiet) print("reports: {}\n", folder.path().string());
  if (!runs.not_kept().empty()) complain("warning: runs are not kept: " + runs.not_kept());
  return interrupted ? exit_interrupted : exit_done;
}

/// For `--depth`. Throws InputError where the seeder cannot be read for one of the two.
std::optional<BothSpaces> both_spaces_of(const AccuracyOptions& options) {
  if (options.depth == 0) return std::nullopt;
  const InputFile file = input_file(options.common.file, FileKind::seeder);
  return read_in_both_spaces(file.path, options.common.overrides(), file.files);
}

int run_table(const AccuracyOptions& options) {
  const Scene scene = scene_of(options);
  const std::optional<BothSpaces> both = both_spaces_of(options);
  const AccuracyDesign design = design_of(options, scene);
  const std::string page_template = options.common.page_template();
  const OutputFolder folder = options.common.output_folder("accuracy", accuracy_file_texts(), "-accuracy");
  const int jobs = threads_to_be_had(options.common.jobs);
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  StudyRuns runs(cases_of(folder.path()));
  const Simulator simulator = runs.caching_simulator(run_model);
  AccuracyResult result;
  AccuracyTiming timing{.jobs = jobs};
  {
    const double of_a_round = std::accumulate(design.runs.begin(), design.runs.end(), 0.0);
    Progress progress(text_unless(options.common.quiet), of_a_round * options.replicates, "runs");
    SweepOptions sweep_options = sweep_options_of(options, jobs, interrupt);
    sweep_options.runs.progress = [&](const ManyRunsProgress& done) { progress.update(done.fraction_done); };
    result = measure_accuracy(scene, design, options.replicates, simulator, sweep_options);
    timing.wall_time = progress.seconds();
  }
  if (options.depth > 0) {
    Progress progress(text_unless(options.common.quiet), 2.0 * options.depth, "runs");
    SweepOptions sweep_options = sweep_options_of(options, jobs, interrupt);
    sweep_options.runs.progress = [&](const ManyRunsProgress& done) { progress.update(done.fraction_done); };
    result.depth = measure_depth_error(resolve_accuracy_level(both->plane), resolve_accuracy_level(both->space),
                                       options.depth, simulator, sweep_options);
    timing.wall_time += progress.seconds();
  }
  std::vector<OutputFile> files = accuracy_files(result, timing, options.common.csv);
  const std::vector<SharedDoubt> doubts = doubts_about(result, scene);
  files.push_back(doubts_file(doubts, "setting"));
  add_page(files, page_template, accuracy_page_data(scene, result));
  write_then_print(
      options.common.quiet, [&] { folder.write(files); },
      [&] {
        print("{}", wrapped(scene.title));
        print("{}", doubts_paragraph(doubts, "setting", all_doubts));
        print("\n{}\n{}", accuracy_table(result), wrapped(accuracy_sentence(result)));
      });
  return ended(options, folder, runs, interrupt);
}

int run_promise(const AccuracyOptions& options) {
  if (options.names_levels())
    throw InputError("--within and --budget choose the setting themselves: name no levels of it");
  const int jobs = threads_to_be_had(options.common.jobs);
  const PromiseGoal goal = goal_of(options, jobs);
  const Scene scene = scene_of(options);
  PromiseChoices choices = choices_of(scene);
  const std::string page_template = options.common.page_template();
  const OutputFolder folder = options.common.output_folder("accuracy", accuracy_file_texts(), "-accuracy");
  const double foreseen = predicted_pilot_cost(choices, scene);
  refuse_small_budget(goal, foreseen, jobs);
  const auto tell = [&](const std::string& what, double cpu_time) {
    if (options.common.quiet) return;
    const bool worth_telling = cpu_time / jobs >= 0.5;  // s; less is told as 0
    complain(worth_telling ? fmt::format("{}: some {}", what, duration_text(cpu_time / jobs)) : what);
  };
  const bool goes_on = !goal.cpu_time && !CaseFolder(cases_of(folder.path())).names().empty();
  tell(goes_on ? "a first round of pilots, without those that are kept" : "a first round of pilots", foreseen);
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  StudyRuns runs(cases_of(folder.path()));
  // What a budget buys is measured by runs that are made now.
  const Simulator simulator = goal.cpu_time ? Simulator(run_model) : runs.caching_simulator(run_model);
  SettingRunner runner(scene, choices.design.settings, simulator, sweep_options_of(options, jobs, interrupt));
  const Progress clock(ProgressStyle::none, 0, "");
  const Promise made = promise(
      choices, goal, with_progress(runner, options.common.quiet),
      [&](int runs, double cpu_time) { tell(fmt::format("{} run{} more", runs, runs == 1 ? "" : "s"), cpu_time); });
  const AccuracyTiming timing{.wall_time = clock.seconds(), .jobs = jobs};
  std::vector<OutputFile> files = promise_files(scene, made, goal, timing, options.common.csv);
  add_page(files, page_template, accuracy_page_data(scene, made, goal));
  write_then_print(
      options.common.quiet, [&] { folder.write(files); },
      [&] { print("{}\n{}", wrapped(scene.title), promise_text(scene, made, goal)); });
  return ended(options, folder, runs, interrupt);
}

}  // namespace

void add_accuracy_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<AccuracyOptions>();
  CLI::App* command = app.add_subcommand("accuracy", "show what accuracy costs in time, for your seeder");
  add_common_options(*command, options->common, "seeder file (.toml)");
  add_html_option(*command, options->common);
  command
      ->add_option("--integrator", options->integrators, "velocity-verlet, rk2-midpoint, gear5; default the first two")
      ->delimiter(',')
      ->type_name("NAME")
      ->check(CLI::IsMember(integrator_names()));
  command
      ->add_option("--steps-per-contact", options->steps_per_contact,
                   "default: the seeder's, twice and four times as many; also as few as are safe")
      ->delimiter(',')
      ->type_name("N")
      ->check(number_within(1, 1e4));
  command
      ->add_option("--shell-compression", options->shell_compressions,
                   "default: the seeder's over 10, itself, and up to 100 times that")
      ->delimiter(',')
      ->type_name("EPS/R")
      ->check(number_within(1e-9, 0.5));
  command
      ->add_option("--youngs-modulus", options->youngs_moduli,
                   "with units: \"50 MPa\"; default with Hertz' law: the seeder's times 10, itself, and down to a "
                   "hundredth")
      ->delimiter(',')
      ->type_name("E");
  command
      ->add_option(
          "--slip-speed", options->slip_speeds,
          "with units: \"20 mm/s\"; default: half the seeder's and four times that, where its friction is sliding")
      ->delimiter(',')
      ->type_name("SPEED");
  CLI::Option* replicates = command
                                ->add_option("--replicates", options->replicates,
                                             "runs of each setting; if no settings are named, rounds of a design")
                                ->type_name("N")
                                ->check(CLI::Range(1, 1000))
                                ->capture_default_str();
  CLI::Option* depth = command
                           ->add_option("--depth", options->depth,
                                        "runs of the tray in 2D and as many in 3D, for the error of the missing depth")
                           ->type_name("N")
                           ->check(CLI::Range(2, 1000));
  CLI::Option* within =
      command
          ->add_option("--within", options->within,
                       "instead: choose a setting and run it, so that the rate errs by at most this: \"3 %\"")
          ->type_name("PERCENT")
          ->excludes(replicates)
          ->excludes(depth);
  command
      ->add_option("--budget", options->budget,
                   "instead: find the smallest error for this CPU time of all jobs: \"2 min\"")
      ->type_name("TIME")
      ->excludes(within)
      ->excludes(replicates)
      ->excludes(depth);
  add_examples(*command,
               {"vibrosow accuracy wheat-tray", "vibrosow accuracy wheat-ball-section --within \"5 %\" --out promise",
                "vibrosow accuracy wheat-ball-section --budget \"5 min\" --out minutes"});
  command->callback(
      [options, &exit_code] { exit_code = options->promises() ? run_promise(*options) : run_table(*options); });
}

}  // namespace vibrosow
