#include "study/predicted_cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "outflow/statistics.hpp"
#include "plan/effects.hpp"
#include "plan/model.hpp"
#include "plan/predicted_grains.hpp"
#include "scene/motion.hpp"
#include "simulation/simulation.hpp"
#include "study/cpu_time.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

constexpr double phase = 0.1;           // s, simulated, to settle and to be timed
constexpr double phase_cpu_time = 0.6;  // s, at most, of each
constexpr double enough_of_rain = 0.8;  // of the run's mean number of grains
constexpr int rounds = 12;
constexpr double round_cpu_time = 5e-3;  // s
constexpr std::int64_t steps_between_looks = 8;

/// CPU time and grain-steps that went into a stretch of a simulation.
struct Stretch {
  double seconds = 0, grain_steps = 0;
  double ns_per_grain_step() const { return grain_steps > 0 ? 1e9 * seconds / grain_steps : 0; }
};

/// Up to `steps` steps, fewer when `most` seconds of CPU time are over or the run ends.
Stretch advance(Simulation& simulation, std::int64_t steps, double most) {
  Stretch stretch;
  const double from = cpu_time();
  bool goes_on = true;
  for (std::int64_t step = 0; step < steps && goes_on && stretch.seconds < most; ++step) {
    stretch.grain_steps += static_cast<double>(simulation.grains().size());
    goes_on = simulation.step();
    if (step % steps_between_looks == 0) stretch.seconds = cpu_time() - from;
  }
  stretch.seconds = cpu_time() - from;
  return stretch;
}

/// Without its ramp, and from the place where it begins with it.
void shake_from_the_start(HarmonicMotion& motion) {
  if (motion.ramp > 0) motion.ramp = motion.phase = 0;
}
void shake_from_the_start(VesselMotion& motion) {
  std::visit(
      [](auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, SumMotion>) {
          for (HarmonicMotion& component : kind.components) shake_from_the_start(component);
        } else if constexpr (std::is_same_v<Kind, HarmonicMotion>) {
          shake_from_the_start(kind);
        } else if constexpr (!std::is_same_v<Kind, TableMotion>) {
          kind.ramp = 0;
        }
      },
      motion);
}

/// The vessels of a scene, to be changed.
template <class Change>
void change_vessels(Scene& scene, Change change) {
  change(scene.tray);
  if (scene.hopper) change(*scene.hopper);
}

/// The scene in full motion from the start: no ramp, no gate, nothing recorded, no limit that ends it.
Scene in_full_motion(Scene scene) {
  change_vessels(scene, [](Vessel& vessel) {
    if (vessel.motion) shake_from_the_start(*vessel.motion);
    for (Hole& hole : vessel.holes) hole.open_at = 0;
  });
  scene.record.reset();
  scene.run.end_after_pause.reset();
  scene.guard.stop_relative_overlap = scene.guard.energy_tolerance = 1e9;
  return scene;
}

/// The motion of a vessel from `from` (s) on, for `span` (s).
TableMotion motion_from(const Vessel& vessel, double from, double span) {
  constexpr int points = 500;
  const VesselPath path(vessel);
  TableMotion motion;
  for (int k = 0; k <= points; ++k) {
    const double time = span * k / points;
    const Pose pose = path.pose(from + time);
    motion.times.push_back(time);
    motion.x.push_back(pose.displacement.x());
    motion.y.push_back(pose.displacement.y());
    motion.angle.push_back(pose.angle);
    motion.z.push_back(pose.across);
  }
  return motion;
}

/// The same of one that turns steadily, which no table would tell from one that rocks.
TurningMotion turning_from(const Vessel& vessel, double from) {
  TurningMotion motion = std::get<TurningMotion>(*vessel.motion);
  const Pose pose = vessel_pose(vessel, from);
  motion.phase = motion.axis == TurningAxis::across ? pose.angle : pose.turn;
  motion.stop -= from;
  return motion;
}

/// The scene as it goes on from `from` (s) for `span` (s), for grains that are where they are then.
Scene continued(Scene scene, double from, double span) {
  change_vessels(scene, [&](Vessel& vessel) {
    if (turns_steadily(vessel))
      vessel.motion = turning_from(vessel, from);
    else if (vessel.motion)
      vessel.motion = motion_from(vessel, from, span);
  });
  return scene;
}

template <class Change>
void change_surfaces(Contact& contact, Change change) {
  change(contact.seed);
  change(contact.wall);
  for (SurfaceOverride& own : contact.overrides) change(own.surface);
}

/// The scene without an effect and what needs it; the same scene for one that makes the bed itself.
Scene without(Scene scene, const std::string& effect) {
  Contact& contact = scene.contact;
  if (effect == "friction") change_surfaces(contact, [](Surface& s) { s.friction = 0; });
  if (effect == "tangential spring") contact.friction_model = FrictionModel::sliding;
  if (effect == "rotation") contact.rotation = false;
  if (effect == "rolling") change_surfaces(contact, [](Surface& s) { s.rolling_friction = s.twisting_friction = 0; });
  if (effect == "damping") change_surfaces(contact, [](Surface& s) { s.restitution = 1; }), contact.damping_rate = 0;
  if (effect == "cohesion") change_surfaces(contact, [](Surface& s) { s.cohesion = 0; });
  if (effect == "drag") contact.drag = 0;
  return scene;
}

/// A scene to be timed with a step of `dt` (s), whatever is safe.
Model model_of(Scene scene, double dt) {
  scene.numerics.dt = dt;
  Model model = prepare(scene);
  model.step.too_long = true;
  return model;
}

/// The same grains for a model of other effects.
Grains grains_for(const Model& model, const Grains& grains) {
  const EffectSet& effects = model.effects;
  Grains same = no_grains(model);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    GrainKind kind = grains.kind(i);
    if (!effects.rotation) kind.inverse_inertia = 0;
    const Eigen::Vector3d at = grains.place(i), velocity = grains.velocity(i);
    Turn turned;
    if (grains.oriented && grains.is_3d) turned.orientation = grains.orientation(i);
    if (grains.oriented && !grains.is_3d) turned.angle = grains.angle[i];
    same.add(at, velocity, grains.lot[i], kind, turned);
    if (!effects.rotation || !grains.rotation) continue;
    same.omega[i] = grains.omega[i];
    if (grains.is_3d) same.omega_x[i] = grains.omega_x[i], same.omega_y[i] = grains.omega_y[i];
  }
  return same;
}

/// A scene's bed, settled and timed.
struct TimedBed {
  Scene scene;
  double dt;  // s
  std::unique_ptr<Simulation> simulation;
  PredictedCost cost;
};

/// `steps` steps, and where it rains as many more as bring `grains` grains, while phase_cpu_time lasts.
void settle(Simulation& simulation, std::int64_t steps, double grains) {
  const Scene& scene = simulation.model().scene;
  const bool rains = scene.tray.rain || (scene.hopper && scene.hopper->rain);
  double left = phase_cpu_time;
  do left -= advance(simulation, steps, left).seconds;
  while (rains && left > 0 && !simulation.at_end() && static_cast<double>(simulation.grains().size()) < grains);
}

TimedBed time_bed(const Model& model, const Grains& start) {
  const StepPlan& plan = model.step;
  TimedBed bed{in_full_motion(model.scene), std::min(plan.dt, plan.longest_safe), nullptr, {}};
  const Model moved = model_of(bed.scene, bed.dt);
  bed.simulation = std::make_unique<Simulation>(moved, starting_state(moved, 1, grains_for(moved, start)));
  bed.cost.grain_steps = predicted_grain_steps(model.scene, plan.dt);
  const auto steps = static_cast<std::int64_t>(phase / bed.dt) + 1;
  settle(*bed.simulation, steps, enough_of_rain * bed.cost.grain_steps / static_cast<double>(plan.steps));
  bed.cost.ns_per_grain_step = advance(*bed.simulation, steps, phase_cpu_time).ns_per_grain_step();
  return bed;
}

/// A bed that goes on without an effect ("": with all).
struct SceneVariant {
  std::string effect;
  std::unique_ptr<Simulation> simulation;
};

std::vector<SceneVariant> variants_of(const TimedBed& bed, double span) {
  const Scene scene = continued(bed.scene, bed.simulation->time(), span);
  const EffectSet effects = prepare(scene).effects;
  std::vector<std::string> names = effect_names(effects);
  names.insert(names.begin(), "");
  std::vector<SceneVariant> variants;
  for (const std::string& name : names) {
    const Model rest = model_of(without(scene, name), bed.dt);
    if (!name.empty() && rest.effects == effects) continue;
    SimulationState state = starting_state(rest, 1, grains_for(rest, bed.simulation->grains()));
    variants.push_back({name, std::make_unique<Simulation>(rest, std::move(state))});
  }
  return variants;
}

}  // namespace

PredictedCost predict_cost(const Scene& scene) {
  const Model model = prepare(scene);
  return time_bed(model, starting_state(model, 1).grains).cost;
}

CostBreakdown break_down_cost(const Model& model, const Grains& start) {
  const TimedBed bed = time_bed(model, start);
  CostBreakdown breakdown{bed.cost, {}};
  const double grains = static_cast<double>(std::max<std::size_t>(1, bed.simulation->grains().size()));
  const auto steps =
      static_cast<std::int64_t>(1 + 1e9 * round_cpu_time / (grains * std::max(1.0, bed.cost.ns_per_grain_step)));
  const std::vector<SceneVariant> variants = variants_of(bed, static_cast<double>((rounds + 1) * steps) * bed.dt);
  std::vector<std::vector<double>> added(variants.size());
  for (int round = 0; round <= rounds; ++round) {
    double all = 0;
    for (std::size_t k = 0; k < variants.size(); ++k) {
      const double ns = advance(*variants[k].simulation, steps, 10 * round_cpu_time).ns_per_grain_step();
      if (k == 0) all = ns;
      if (round > 0) added[k].push_back(all - ns);  // in the first the lists are new
    }
  }
  for (std::size_t k = 1; k < variants.size(); ++k) {
    const MeanWithInterval difference = mean_with_interval(added[k]);
    breakdown.effects.push_back({variants[k].effect, difference.mean, *difference.half_width_95});
  }
  return breakdown;
}

double predict_seconds(const std::vector<const Scene*>& scenes) {
  constexpr std::size_t most_timed = 5;
  const std::size_t stride = (scenes.size() + most_timed - 1) / most_timed;
  double seconds = 0;
  PredictedCost cost;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    if (k % stride == 0) cost = predict_cost(*scenes[k]);
    cost.grain_steps = predicted_grain_steps(*scenes[k], prepare(*scenes[k]).step.dt);
    seconds += cost.seconds();
  }
  return seconds;
}

double predict_seconds(const Study& study) {
  std::vector<const Scene*> scenes;
  for (const Scene& scene : study.scenes) scenes.push_back(&scene);
  return study.replicates.first() * predict_seconds(scenes);
}

double usual_seconds(const Scene& scene) {
  const double disc = scene.space == Space::two_dimensional ? 25e-9 : 70e-9;  // s
  double discs = 0;                                                           // of a seed, mean
  for (const SeedLot& lot : scene.lots)
    discs += lot.number_fraction * static_cast<double>(std::max<std::size_t>(1, lot.discs.size()));
  return disc * discs * predicted_grain_steps(scene, prepare(scene).step.dt);
}

}  // namespace vibrosow
