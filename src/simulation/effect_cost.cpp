#include "simulation/effect_cost.hpp"

#include <algorithm>
#include <chrono>

#include "plan/effects.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

/// A box of 40 x 15 grains of 4 mm, at rest or shaken, with the scene's law, scheme and motion of contacts, and as many
/// discs a clump.
Scene sample_bed(const Scene& of, const EffectSet& effects) {
  Scene scene;
  scene.lots = {{"a", 4e-3, 40e-6, Shape::ball, effects.polydisperse ? 0.5 : 1.0}};
  if (effects.polydisperse) scene.lots.push_back({"b", 3.6e-3, 30e-6, Shape::ball, 0.5});
  if (effects.clumps) {
    scene.lots = {of.lots.front()};
    for (const SeedLot& lot : of.lots)
      if (lot.discs.size() > scene.lots.front().discs.size()) scene.lots = {lot};
    scene.lots.front().number_fraction = 1;
    scene.lots.front().sizes = {};
  }
  const double diameter = scene.lots.front().diameter;
  Contact& contact = scene.contact;
  contact = of.contact;
  contact.overrides.clear();
  contact.seed.friction = contact.wall.friction = effects.friction ? 0.3 : 0.0;
  contact.seed.restitution = contact.wall.restitution = effects.damping ? 0.5 : 1.0;
  if (contact.law == Law::hertz_viscous) contact.damping_rate = effects.damping ? of.contact.damping_rate : 0.0;
  contact.seed.rolling_friction = contact.wall.rolling_friction = effects.rolling == Rolling::none ? 0.0 : 0.05;
  contact.seed.cohesion = contact.wall.cohesion =
      effects.cohesion ? 0.1 * scene.lots.front().mass * standard_gravity : 0.0;
  contact.friction_model = effects.tangential_spring ? FrictionModel::spring : FrictionModel::sliding;
  contact.rolling = effects.rolling;
  contact.rotation = effects.rotation;
  contact.slip_speed = 0.1;
  contact.drag = effects.drag ? 1e-6 : 0.0;
  scene.numerics.integrator = of.numerics.integrator;
  scene.tray.name = "tray";
  scene.tray.length = 40.5 * diameter;
  scene.tray.height = 50 * diameter;
  scene.tray.fill = Fill{600, Packing::hexagonal, 1e-3, false};
  if (effects.motion) scene.tray.motion = HarmonicMotion{0, 0.25 * diameter, 9, 0};
  if (effects.periodic) scene.tray.sides = Sides::periodic;
  scene.run.duration = 1;
  return scene;
}

double ns_per_grain_step(const Scene& of, const EffectSet& effects) {
  constexpr std::int64_t steps = 400;
  constexpr int repeats = 3;
  const Scene scene = sample_bed(of, effects);
  Simulation simulation(prepare(scene, effects), 1);
  double best = 1e300;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto from = std::chrono::steady_clock::now();
    simulation.steps(steps);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - from;
    best = std::min(best, taken.count() / static_cast<double>(steps) / static_cast<double>(simulation.grains().size()));
  }
  return best;
}

/// What is left when one effect is taken out with those that need it.
EffectSet without(EffectSet effects, const std::string& effect) {
  if (effect == "friction") effects.friction = effects.tangential_spring = false, effects.rolling = Rolling::none;
  if (effect == "tangential spring") effects.tangential_spring = false;
  if (effect == "rotation") effects.rotation = false, effects.rolling = Rolling::none;
  if (effect == "rolling") effects.rolling = Rolling::none;
  if (effect == "damping") effects.damping = false;
  if (effect == "cohesion") effects.cohesion = false;
  if (effect == "polydisperse" && !effects.clumps) effects.polydisperse = false;
  if (effect == "clumps") effects.clumps = effects.polydisperse = false;
  if (effect == "drag") effects.drag = false;
  if (effect == "motion") effects.motion = false;
  if (effect == "periodic") effects.periodic = false;
  if (!effects.friction && !effects.clumps) effects.rotation = false;
  return effects;
}

}  // namespace

std::vector<EffectCost> effect_costs(const Scene& scene) {
  const EffectSet effects = effects_of(scene);
  const double all = ns_per_grain_step(scene, effects);
  std::vector<EffectCost> costs{{"all effects present", all}};
  for (const std::string& effect : effect_names(effects)) {
    const EffectSet rest = without(effects, effect);
    if (rest != effects) costs.push_back({effect, all - ns_per_grain_step(scene, rest)});
  }
  return costs;
}

}  // namespace vibrosow
