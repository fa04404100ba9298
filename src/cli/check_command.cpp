#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "design/study.hpp"
#include "input/key_units.hpp"
#include "input/measured.hpp"
#include "input/read_scene.hpp"
#include "plan/effects.hpp"
#include "plan/step_plan.hpp"
#include "scene/input_error.hpp"
#include "simulation/effect_cost.hpp"

namespace vibrosow {
namespace {

/// Seeds at the start, and of rain as many as have come on average over the run.
double grains_in(const Vessel& vessel, double duration) {
  double grains = vessel.fill ? vessel.fill->count : 0;
  if (!vessel.rain) return grains;
  const double stop = std::min(vessel.rain->stop, duration), start = std::min(vessel.rain->start, stop);
  return grains + vessel.rain->rate * (stop - start) * (duration - 0.5 * (start + stop)) / duration;
}

/// Grains times steps; outflow lessens it, topping up adds to it.
double predicted_grain_steps(const Scene& scene, const StepPlan& plan) {
  double grains = grains_in(scene.tray, scene.run.duration);
  if (scene.hopper) grains += grains_in(*scene.hopper, scene.run.duration);
  return grains * static_cast<double>(plan.steps);
}

void print_effects(const Scene& scene, const std::vector<EffectCost>& costs) {
  print("effects\n");
  for (const EffectReason& effect : explain_effects(scene))
    print("  {:<3} {:<17} {}\n", effect.present ? "yes" : "no", effect.effect, effect.reason);
  print("cost on this machine, now\n");
  for (const EffectCost& cost : costs)  // a difference of two timings can fall below zero
    print("  {:<22} {:8.1f} ns per grain-step\n", cost.effect, std::max(0.0, cost.ns_per_grain_step));
}

void print_step(const Scene& scene, const StepPlan& plan, double ns_per_grain_step) {
  print("step\n  dt {:.4g} s, shortest contact {:.4g} s: {:.3g} steps a contact\n", plan.dt, plan.contact_duration,
        plan.contact_duration / plan.dt);
  for (const StepLimit& limit : plan.limits) print("  at most {:.4g} s: {}\n", limit.dt, limit.reason);
  print("  longest safe step {:.4g} s ({})\n", plan.longest_safe, plan.bound_by);
  const double grain_steps = predicted_grain_steps(scene, plan);
  print("  {} steps, about {:.3g} grain-steps: some {:.2g} s of one core\n", plan.steps, grain_steps,
        1e-9 * ns_per_grain_step * grain_steps);
}

void print_compression(const Scene& scene) {
  const PredictedCompression predicted = predict_compression(scene);
  print("compression predicted, d/r\n  at rest {:.3g} under {:.3g} layers (overlap of the lowest pair {:.3g} r)\n",
        predicted.static_compression, predicted.layers, predicted.static_overlap);
  print("  at impact {:.3g} at {:.3g} m/s\n", predicted.impact_compression, predicted.impact_speed);
  const double warn = scene.guard.warn_compression;
  if (predicted.static_compression <= warn && predicted.impact_compression <= warn) return;
  print("  warning: beyond guard.warn_compression = {:g}: {}\n", warn,
        scene.contact.law == Law::elastic_shell
            ? fmt::format("a shell is thin; contact.shell_compression = {:.2g} would do", predicted.stiff_enough)
            : "Hertz' law is for small overlaps; a larger contact.youngs_modulus is stiffer");
}

void print_vessel(const Vessel& vessel) {
  print("{}\n  floor from ({:.1f}, {:.1f}) mm, {:.1f} mm long, end walls {:.1f} mm, {} seeds\n", vessel.name,
        vessel.origin.x() * 1e3, vessel.origin.y() * 1e3, vessel.length * 1e3, vessel.height * 1e3,
        vessel.fill ? vessel.fill->count : 0);
  for (std::size_t i = 0; i < vessel.holes.size(); ++i)
    print("  hole {} at {:.2f} mm, {:.2f} mm wide{}\n", i + 1, vessel.holes[i].centre * 1e3,
          vessel.holes[i].width * 1e3,
          vessel.holes[i].open_at > 0 ? fmt::format(", opens at {:.6g} s", vessel.holes[i].open_at) : "");
  if (vessel.rain)
    print("  rain of {:.6g} seeds/s from {:.1f} mm above its floor\n", vessel.rain->rate, vessel.rain->height * 1e3);
}

int check_seeder(const CommonOptions& options) {
  const Scene scene = read_scene(options.file, options.overrides());
  const StepPlan plan = plan_step(scene);
  print("{}\n", scene.title);
  print_vessel(scene.tray);
  if (scene.hopper) print_vessel(*scene.hopper);
  const std::vector<EffectCost> costs = effect_costs(scene);
  print_effects(scene, costs);
  print_step(scene, plan, costs.front().ns_per_grain_step);
  print_compression(scene);
  if (const auto refused = step_refused(scene, plan)) throw InputError(*refused);
  if (plan.too_long) print("the step is too long and insisted on: every result will be marked \"outside the model\"\n");
  return exit_done;
}

/// The header of a table of measured outflow for this study, ready to fill in.
std::string measured_header(const Study& study) {
  std::string header;
  for (const std::string& key : study.keys) header += condition_column(key) + ",";
  return header + "hole,lot,repeat,caught_g,duration_s,note";
}

int check_study(const CommonOptions& options) {
  const Study study = read_study(options.file, options.overrides());
  double grain_steps = 0;
  for (const Scene& scene : study.scenes) grain_steps += predicted_grain_steps(scene, plan_step(scene));
  print("{}\n{} layouts, {} different scenes, {} runs of each, about {:.3g} grain-steps in all\n", study.title,
        study.layouts.size(), study.scenes.size(), study.replicates, grain_steps * study.replicates);
  for (const Layout& layout : study.layouts)
    if (!layout.scene) print("layout {} {}: invalid: {}\n", layout.number, layout.name, layout.invalid);
  if (study.measured)
    print("measured: {}, {} series, {} matched to layouts\n", study.measured->file.string(),
          study.measured->table.series.size(), study.measured->matches.size());
  print("header of a table of measured outflow:\n{}\n", measured_header(study));
  return exit_done;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command =
      app.add_subcommand("check", "validate a seeder or a study; effects, step, predicted overlap and cost");
  add_input_options(*command, *options, "seeder or study file (.toml)");
  command->callback(
      [options, &exit_code] { exit_code = is_study(options->file) ? check_study(*options) : check_seeder(*options); });
}

}  // namespace vibrosow
