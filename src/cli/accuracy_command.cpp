#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/threads.hpp"
#include "design/accuracy.hpp"
#include "input/input_file.hpp"
#include "input/read_scene.hpp"
#include "laws/law.hpp"
#include "plan/scene_warnings.hpp"
#include "report/accuracy_report.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "scene/integrator_names.hpp"
#include "simulation/simulate.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct AccuracyOptions {
  CommonOptions common;
  std::vector<std::string> integrators;
  std::vector<double> steps_per_contact, shell_compressions;
  std::vector<std::string> youngs_moduli, slip_speeds;
  int replicates = 5;
};

/// CLI::Range takes nan.
CLI::Validator number_within(double least, double most) {
  return {[least, most](const std::string& text) {
            double number = 0;
            const bool within = CLI::detail::lexical_cast(text, number) && number >= least && number <= most;
            return within ? "" : fmt::format("\"{}\" is not a number from {:g} to {:g}", text, least, most);
          },
          "NUMBER"};
}

/// A list of quantities of one option, each from `least` to `most` (SI), which `range` states.
std::vector<double> quantities(const char* option, const std::vector<std::string>& texts, Dimension dimension,
                               double least, double most, const char* range) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    try {
      values.push_back(parse_quantity(text, dimension));
    } catch (const UnitError& error) {
      throw InputError(fmt::format("{}: {}", option, error.what()));
    }
    if (values.back() < least || values.back() > most)
      throw InputError(fmt::format("{}: \"{}\" is out of range, which is from {}", option, text, range));
  }
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
    grid.youngs_moduli =
        quantities("--youngs-modulus", options.youngs_moduli, Dimension::pressure, 1, 1e13, "1 Pa to 1e+07 MPa");
  if (!options.slip_speeds.empty() && grid.slip_speeds.empty())
    throw InputError(fmt::format("--slip-speed: the friction of {} has none", options.common.file));
  if (!options.slip_speeds.empty())
    grid.slip_speeds =
        quantities("--slip-speed", options.slip_speeds, Dimension::speed, 1e-6, 100, "1e-06 m/s to 100 m/s");
  if (!options.integrators.empty()) {
    grid.integrators.clear();
    for (const std::string& name : options.integrators) grid.integrators.push_back(integrator_of(name));
  }
  return grid;
}

int run_accuracy(const AccuracyOptions& options) {
  const InputFile file = input_file(options.common.file, FileKind::seeder);
  const Scene scene = read_scene(file.path, options.common.overrides(), file.files);
  print_warnings(scene_warnings(scene));
  const AccuracyGrid grid = grid_of(options, scene);
  const OutputFolder folder = options.common.output_folder("accuracy", accuracy_file_texts(), "-accuracy");
  const int jobs = threads_to_be_had(options.common.jobs);
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  const auto settings = static_cast<double>(settings_of(grid).size());
  AccuracyResult result;
  double wall_time = 0;
  {
    Progress progress(options.common.quiet, settings * options.replicates, "runs");
    SweepOptions sweep_options;
    sweep_options.first_random_seed = options.common.random_seed;
    sweep_options.runs.jobs = jobs;
    sweep_options.runs.interrupt = &interrupt;
    sweep_options.runs.progress = [&](const ManyRunsProgress& done) { progress.update(done.fraction_done); };
    result = measure_accuracy(scene, grid, options.replicates, run_model, sweep_options);
    wall_time = progress.seconds();
  }
  write_then_print(
      options.common.quiet, [&] { folder.write(accuracy_files(result, wall_time, jobs, options.common.csv)); },
      [&] { print("{}\n{}\n{}", wrapped(scene.title), accuracy_table(result), wrapped(accuracy_sentence(result))); });
  if (!options.common.quiet) print("reports: {}\n", folder.path().string());
  return interrupt ? exit_interrupted : exit_done;
}

}  // namespace

void add_accuracy_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<AccuracyOptions>();
  CLI::App* command = app.add_subcommand("accuracy", "what accuracy costs in time, on a seeder of yours");
  add_common_options(*command, options->common, "seeder file (.toml)");
  command
      ->add_option("--integrator", options->integrators, "velocity-verlet, rk2-midpoint, gear5; default the first two")
      ->delimiter(',')
      ->type_name("NAME")
      ->check(CLI::IsMember(integrator_names()));
  command->add_option("--steps-per-contact", options->steps_per_contact, "default 10,20,40")
      ->delimiter(',')
      ->type_name("N")
      ->check(number_within(1, 1e4));
  command
      ->add_option("--shell-compression", options->shell_compressions,
                   "default: the seeder's, times 1, 10 and 100, up to 0.05")
      ->delimiter(',')
      ->type_name("EPS/R")
      ->check(number_within(1e-9, 0.5));
  command
      ->add_option("--youngs-modulus", options->youngs_moduli,
                   "with units: \"50 MPa\"; default with Hertz' law: the seeder's, over 1, 10 and 100")
      ->delimiter(',')
      ->type_name("E");
  command
      ->add_option("--slip-speed", options->slip_speeds,
                   "with units: \"20 mm/s\"; default: the seeder's, times 1 and 5, where its friction is sliding")
      ->delimiter(',')
      ->type_name("SPEED");
  command->add_option("--replicates", options->replicates, "runs of each setting")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_accuracy(*options); });
}

}  // namespace vibrosow
