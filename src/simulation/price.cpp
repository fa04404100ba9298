#include "simulation/price.hpp"

#include <algorithm>
#include <chrono>

#include "simulation/simulation.hpp"
#include "simulation/step_plan.hpp"

namespace vibrosow {
namespace {

/// A box of 40 x 15 grains of 4 mm, at rest or shaken.
Scene sample_bed(const EffectSet& effects) {
  Scene scene;
  scene.lots = {{"a", 4e-3, 40e-6, Shape::ball, effects.unequal ? 0.5 : 1.0}};
  if (effects.unequal) scene.lots.push_back({"b", 3.6e-3, 30e-6, Shape::ball, 0.5});
  const Surface surface{effects.friction ? 0.3 : 0.0, effects.damping ? 0.5 : 1.0};
  scene.contact.seed = scene.contact.wall = surface;
  scene.contact.rotation = effects.rotation;
  scene.contact.slip_speed = 0.1;
  scene.contact.drag = effects.drag ? 1e-6 : 0.0;
  scene.tray.name = "tray";
  scene.tray.length = 0.162;
  scene.tray.height = 0.2;
  scene.tray.fill = Fill{600, Packing::hexagonal, 1e-3, false};
  if (effects.motion) scene.tray.motion = HarmonicMotion{0, 1e-3, 9, 0};
  scene.run.duration = 1;
  return scene;
}

double ns_per_grain_step(const EffectSet& effects) {
  constexpr std::int64_t steps = 400;
  constexpr int repeats = 3;
  const Scene scene = sample_bed(effects);
  Simulation simulation(scene, starting_grains(scene, 1, effects), {.dt = plan_step(scene).dt, .effects = effects});
  double best = 1e300;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto from = std::chrono::steady_clock::now();
    simulation.steps(steps);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - from;
    best = std::min(best, taken.count() / static_cast<double>(steps) / static_cast<double>(simulation.grains().size()));
  }
  return best;
}

}  // namespace

std::vector<EffectPrice> price_list(const EffectSet& effects) {
  const double all = ns_per_grain_step(effects);
  std::vector<EffectPrice> prices{{"all effects present", all}};
  const auto add = [&](const char* name, bool EffectSet::*effect) {
    if (!(effects.*effect)) return;
    EffectSet without = effects;
    without.*effect = false;
    if (!without.friction) without.rotation = false;
    prices.push_back({name, all - ns_per_grain_step(without)});
  };
  add("friction", &EffectSet::friction);
  add("rotation", &EffectSet::rotation);
  add("damping", &EffectSet::damping);
  add("unequal", &EffectSet::unequal);
  add("drag", &EffectSet::drag);
  add("motion", &EffectSet::motion);
  return prices;
}

}  // namespace vibrosow
