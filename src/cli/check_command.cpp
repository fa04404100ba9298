#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/compare_spaces.hpp"
#include "cli/console.hpp"
#include "cli/drill_table.hpp"
#include "cli/help_text.hpp"
#include "cli/progress.hpp"
#include "grains/fill_height.hpp"
#include "input/input_file.hpp"
#include "input/key_units.hpp"
#include "input/measured.hpp"
#include "input/read_scene.hpp"
#include "plan/effects.hpp"
#include "plan/fill_warnings.hpp"
#include "plan/model.hpp"
#include "plan/scene_warnings.hpp"
#include "plan/softness.hpp"
#include "report/mixture_text.hpp"
#include "report/number_text.hpp"
#include "report/terminal_text.hpp"
#include "scene/accuracy_level.hpp"
#include "scene/input_error.hpp"
#include "scene/integrator_names.hpp"
#include "scene/measuring_window.hpp"
#include "scene/spaces.hpp"
#include "simulation/state.hpp"
#include "study/predicted_cost.hpp"
#include "study/study.hpp"

namespace vibrosow {
namespace {

std::string friction_text(const Model& model) {
  if (!model.effects.friction) return "none: nothing rubs";
  if (model.effects.tangential_spring) return "spring: a tangential spring up to Coulomb's limit";
  return fmt::format("sliding: Coulomb's limit, less below the slip speed of {:g} mm/s",
                     model.scene.contact.slip_speed * 1e3);
}

std::string softness_text(const Model& model) {
  const double softness = softness_of(model.scene, *model.law);
  return model.law->material == LawMaterial::shell ? fmt::format("shell compression {:.3g}", softness)
                                                   : fmt::format("Young's modulus {:.4g} MPa", 1e-6 / softness);
}

/// The laws by which contacts push, rub and roll, and the scheme that moves the seeds.
void print_model(const Model& model, AccuracyLevel wanted) {
  const auto line = [](std::string_view what, const std::string& text) {
    print_text(wrapped_beside(fmt::format("  {:<9} ", what), text));
  };
  print("model\n");
  line("law", fmt::format("{}: {}", model.law->name, model.law->description));
  line("friction", friction_text(model));
  if (model.effects.rolling != Rolling::none)
    line("rolling", model.effects.rolling == Rolling::spring ? "spring: a rolling spring up to its limit"
                                                             : "constant torque: a torque against rolling");
  line("scheme", integrator_name(model.scene.numerics.integrator));
  line("softness", softness_text(model));
  const auto level = std::ranges::find(accuracy_levels, wanted, &AccuracyLevelValues::level);
  if (level == accuracy_levels.end()) return;
  line("accuracy", fmt::format("{}: known to err by at most {:g} %", level->name,
                               100 * level->error(model.scene.space, has_clumps(model.scene.lots))));
}

void print_effects(const Model& model, const CostBreakdown& cost) {
  print("effects\n");
  for (const EffectReason& effect : explain_effects(model.scene, model.effects, *model.law))
    print_text(
        wrapped_beside(fmt::format("  {:<3} {:<17} ", effect.present ? "yes" : "no", effect.effect), effect.reason));
  print("cost on this machine, now, ns of CPU time per grain-step; of an effect, what\nleaving it out saves\n");
  print("  {:<22} {:6.1f}\n", "all effects present", cost.whole.ns_per_grain_step);
  for (const EffectCost& effect : cost.effects)
    if (effect.is_resolved())
      print("  {:<22} {:6.1f} +- {:.1f}\n", effect.effect, effect.ns_per_grain_step, effect.half_width_95);
    else
      print("  {:<22} less than {:.1f}, too little for this timing\n", effect.effect,
            std::max(0.0, effect.ns_per_grain_step) + effect.half_width_95);
}

void print_step(const StepPlan& plan, const PredictedCost& cost) {
  print("step\n  dt {:.4g} s, shortest contact {}: {:.3g} steps a contact\n", plan.dt, time_text(plan.contact_duration),
        plan.contact_duration / plan.dt);
  for (const StepLimit& limit : plan.limits)
    print_text(wrapped_beside(fmt::format("  at most {:.4g} s: ", limit.dt), limit.reason));
  print_text(wrapped(fmt::format("longest safe step {:.4g} s ({})", plan.longest_safe, plan.bound_by), 2));
  print("  {} steps, about {} grain-steps: some {:.2g} s of CPU time\n", plan.steps, count_text(cost.grain_steps),
        cost.seconds());
}

/// What keeps overlaps small.
std::string advice(const LawTraits& law, const PredictedOverlap& predicted) {
  const std::string stiffer = fmt::format("take a {} {}", law.stiffer_value(), law.stiffness_key());
  return law.material == LawMaterial::shell ? fmt::format("{}: {:.2g} would do", stiffer, predicted.stiff_enough)
                                            : stiffer;
}

void print_overlap(const Model& model) {
  const PredictedOverlap& predicted = model.overlap;
  print(
      "relative overlap predicted (a grain's share of the overlap over its radius)\n  at rest {:.3g} under {:.3g} "
      "layers (overlap of the lowest pair {:.3g} r)\n",
      predicted.overlap_at_rest, predicted.layers, predicted.pair_overlap_at_rest);
  print("  at impact {:.3g} at {:.3g} m/s\n", predicted.overlap_at_impact, predicted.impact_speed);
  const double warn = model.scene.guard.warn_relative_overlap;
  if (predicted.overlap_at_rest <= warn && predicted.overlap_at_impact <= warn) return;
  print_text(
      wrapped_beside("  warning: ", fmt::format("beyond guard.warn_relative_overlap = {:g}, and the law is for small "
                                                "overlaps; {}",
                                                warn, advice(*model.law, predicted))));
}

std::string hole_text(const Hole& hole, Space space) {
  const double mm = 1e3;
  std::string plane = fmt::format("at {:.2f} mm, {:.2f} mm wide", hole.centre * mm, hole.width * mm);
  if (space == Space::two_dimensional) return plane;
  if (hole.shape == HoleShape::round)
    return fmt::format("at {:.2f} mm, {:.2f} mm from the front, {:.2f} mm in diameter", hole.centre * mm,
                       hole.across * mm, hole.width * mm);
  return fmt::format("{}, {:.2f} mm from front to back, its middle {:.2f} mm from the front", plane,
                     hole.across_length * mm, hole.across * mm);
}

std::string fill_text(const Vessel& vessel, const Scene& scene) {
  if (!vessel.fill) return "0 seeds";
  return fmt::format("{} seeds, some {:.3g} mm high", vessel.fill->count,
                     height_of_fill(vessel, scene.lots, scene.space) * 1e3);
}

std::string rain_text(const Rain& rain, const Scene& scene) {
  std::string text = fmt::format("rain of {:.6g} seeds/s", rain.rate);
  if (const auto factor = scene.space == Space::two_dimensional ? slices_of_tray(scene) : std::nullopt)
    text += fmt::format(" in the slice, {:.4g} of the whole tray,", rain.rate * *factor);
  text += fmt::format(" from {:.1f} mm above its floor", rain.height * 1e3);
  if (rain.start > 0) text += fmt::format(", from {:.6g} s on", rain.start);
  if (rain.stop < scene.run.duration) text += fmt::format(", until {:.6g} s", rain.stop);
  return text;
}

void print_vessel(const Vessel& vessel, const Scene& scene) {
  const Space space = scene.space;
  const double mm = 1e3;
  const bool round = space == Space::three_dimensional && vessel.plan == Plan::round;
  const std::string depth =
      space == Space::two_dimensional || round ? "" : fmt::format("{:.1f} mm deep, ", *vessel.depth * mm);
  print("{}\n", vessel.name);
  print_text(wrapped_beside(
      "  ",
      fmt::format("{}floor from ({:.1f}, {:.1f}) mm, {:.1f} mm {}, {}walls {:.1f} mm, {}", round ? "round, " : "",
                  vessel.origin.x() * mm, vessel.origin.y() * mm, vessel.length * mm, round ? "in diameter" : "long",
                  space == Space::two_dimensional ? "end " : depth, vessel.height * mm, fill_text(vessel, scene))));
  for (std::size_t i = 0; i < vessel.holes.size(); ++i)
    print("  hole {} {}{}\n", i + 1, hole_text(vessel.holes[i], space),
          vessel.holes[i].open_at > 0 ? fmt::format(", opens at {:.6g} s", vessel.holes[i].open_at) : "");
  if (vessel.tilt != 0)
    print_text(wrapped_beside(
        "  ",
        fmt::format("tilted by {:.4g} degree, {} end up; its walls, holes and pieces are tilted with it, gravity and "
                    "the direction of its motion are not: 0 degree is level, 90 degree straight up",
                    std::abs(vessel.tilt) * 180 / std::numbers::pi, vessel.tilt > 0 ? "right" : "left")));
  if (vessel.rain) print("  {}\n", rain_text(*vessel.rain, scene));
}

/// How many slices the tray is taken for, and how dense a bed that means.
void print_slice(const Scene& scene) {
  const auto slices = slices_of_tray(scene);
  if (scene.space != Space::two_dimensional || !slices) return;
  const double implied = implied_bulk_density(scene.lots, poured_share);
  const auto solid = solid_density(scene.lots);
  print_text(
      wrapped(fmt::format("the tray is {} slices {:.4g} mm thick: a bed of some {:.3g} kg/m3 when poured{}",
                          to_digits(*slices, 4), slice_thickness(scene.lots) * 1e3, implied,
                          solid ? fmt::format(", {:.0f} % of the seeds' own density", 100 * implied / *solid) : "")));
}

/// What `run` begins with. Throws InputError as that does, but where it is `refused` before the fill is looked at:
/// none.
std::optional<SimulationState> start_of_run(const Model& model, bool refused) {
  try {
    return starting_state(model, CommonOptions{}.random_seed);
  } catch (const InputError&) {
    if (!refused) throw;
    return std::nullopt;
  }
}

struct CheckOptions : CommonOptions {
  bool both = false;
};

int check_seeder(const InputFile& file, const CheckOptions& options) {
  const auto [read, drill, drawings] = read_seeder(file.path, options.overrides(), file.files);
  const Model model = prepare(read);
  const Scene& scene = model.scene;
  print_warnings(scene_warnings(scene));
  tell_of_files(file);
  const StepPlan& plan = model.step;
  print_text(wrapped(scene.title));
  print_vessel(scene.tray, scene);
  if (scene.hopper) print_vessel(*scene.hopper, scene);
  print_slice(scene);
  if (!scene.tray.holes.empty()) print_text(wrapped(window_sentence(measuring_window(scene), scene.run.measure_from)));
  for (const Drawing& drawing : drawings) print_text(wrapped(drawing_text(drawing, scene)));
  if (drill) print_text(wrapped(drill_sentence(*drill)));
  print_space_advice(scene);
  print_model(model, read.numerics.accuracy);
  const auto refused = step_refused(scene.numerics, plan);
  const auto start = start_of_run(model, refused.has_value());
  const std::vector<DrawnSeeds> drawn = start ? start->run.drawn : std::vector<DrawnSeeds>();
  print_text(mixture_text(scene, drawn));
  if (start) {
    print_warnings(drawn_warnings(scene, drawn));
    print_warnings(fill_warnings(scene, start->grains));
    const CostBreakdown cost = break_down_cost(model, start->grains);
    print_effects(model, cost);
    print_step(plan, cost.whole);
    print_overlap(model);
    if (start->guard.stop_reason) {
      print_warnings({*start->guard.stop_reason});
      return exit_stopped_by_guard;
    }
  }
  if (refused) throw InputError(*refused);
  if (plan.too_long) print("the step is too long and allowed: every result will be marked \"outside the model\"\n");
  if (!options.both) return exit_done;
  const BothSpaces both = read_in_both_spaces(file.path, options.overrides(), file.files);
  std::vector<std::string> of_the_other =
      scene_warnings(read.space == Space::two_dimensional ? both.space : both.plane);
  const std::vector<std::string> told = scene_warnings(scene);
  std::erase_if(of_the_other, [&](const std::string& one) { return std::ranges::find(told, one) != told.end(); });
  print_warnings(of_the_other);
  return run_in_both_spaces(both);
}

/// The header of a table of measured outflow for this study, ready to fill in.
std::string measured_header(const Study& study) {
  std::string header;
  for (const std::string& key : study.keys) header += condition_column(key) + ",";
  return header + "hole,lot,repeat,caught_g,duration_s,note";
}

std::string replicates_text(const Replicates& replicates) {
  return replicates.interval ? fmt::format("{} to {}", replicates.first(), replicates.most)
                             : std::to_string(replicates.number);
}

int check_study(const InputFile& file, const CheckOptions& options) {
  if (options.both) throw InputError("--both: is for one seeder, not for a study");
  const Study study = read_study(file.path, options.overrides(), file.files);
  print_warnings(study_warnings(study));
  tell_of_files(file);
  print_text(wrapped(study.title));
  print_text(wrapped(fmt::format("{} layouts, {} different scenes, {} runs of each: some {} of CPU time in all",
                                 study.layouts.size(), study.scenes.size(), replicates_text(study.replicates),
                                 duration_text(predict_seconds(study)))));
  for (const Layout& layout : study.layouts)
    if (!layout.scene)
      print_text(wrapped(fmt::format("layout {} {}: invalid: {}", layout.number, layout.name, layout.invalid)));
  if (study.measured)
    print_text(wrapped(fmt::format("measured: {}, {} series, {} of them of a layout", study.measured->file.string(),
                                   study.measured->table.series.size(), compared_series(*study.measured))));
  print("columns of a CSV table, to compare this study with measured outflow:\n{}\n", measured_header(study));
  return exit_done;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "validate a seeder or a study; show effects, step, predicted overlap and cost");
  add_input_options(*command, *options, "seeder or study file (.toml)");
  command->add_flag("--both", options->both, "run the seeder in 2D and in 3D, and print the ratio of their rates");
  add_examples(*command, {"vibrosow check wheat-tray", "vibrosow check my-wheat-tray.toml --set tray.holes.count=3",
                          "vibrosow check pea-tray-3d"});
  command->callback([options, &exit_code] {
    const InputFile file = input_file(options->file);
    exit_code = file.kind == FileKind::study ? check_study(file, *options) : check_seeder(file, *options);
  });
}

}  // namespace vibrosow
