// The cost list of effects: the published tray (2400 discs, stiff shells, closed, shaken) with every effect, with each
// one left out, and with normal contact alone. CSV on stdout: ns per grain-step, the median of rounds that take the
// cases in turn, and what the effect adds. The last row but one runs the kernel of all effects on a scene that calls
// for few.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "plan/step_plan.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

struct Case {
  std::string name;
  EffectSet effects;
  bool kernel_of_all = false;
};

const EffectSet every_effect{.friction = true,
                             .rotation = true,
                             .damping = true,
                             .polydisperse = true,
                             .drag = true,
                             .motion = true,
                             .tangential_spring = true,
                             .rolling = Rolling::spring,
                             .cohesion = true};

Scene tray_with(const EffectSet& effects) {
  Scene scene;
  scene.lots = {{"grain", 8e-3, 0.6e-3, Shape::disc, effects.polydisperse ? 0.5 : 1.0}};
  if (effects.polydisperse) scene.lots.push_back({"other", 7.6e-3, 0.55e-3, Shape::disc, 0.5});
  Contact& contact = scene.contact;
  contact.shell_compression = 1e-4;
  contact.seed = contact.wall = {effects.friction ? 0.3 : 0.0, effects.damping ? 0.5 : 1.0};
  contact.friction_model = effects.tangential_spring ? FrictionModel::spring : FrictionModel::sliding;
  contact.rotation = effects.rotation;
  contact.slip_speed = 0.1;
  contact.rolling = effects.rolling;
  contact.seed.rolling_friction = effects.rolling == Rolling::none ? 0 : 0.05;
  contact.seed.cohesion = effects.cohesion ? 1e-3 : 0;
  contact.drag = effects.drag ? 1e-5 : 0;
  scene.tray.name = "tray";
  scene.tray.length = 0.5;
  scene.tray.height = 0.45;
  scene.tray.fill = Fill{2400, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, effects.motion ? 0.01 : 0, 9, 0};
  scene.guard.stop_relative_overlap = scene.guard.energy_tolerance = 1e9;
  scene.run.duration = 2;
  return scene;
}

/// Settled for 0.1 s and then timed for 1000 steps; ns per grain-step.
double cost(const Case& of) {
  Scene scene = tray_with(of.effects);
  scene.numerics.dt = 1e-5;
  EffectSet run_with = of.effects;
  if (of.kernel_of_all) {
    run_with = all_pair_effects(of.effects);
    run_with.drag = true;
  }
  Simulation simulation(prepare(scene, run_with), 1);
  simulation.steps(10000);
  const auto from = std::chrono::steady_clock::now();
  simulation.steps(1000);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - from).count() / 1000 /
         static_cast<double>(simulation.grains().size());
}

std::vector<Case> cases() {
  std::vector<Case> all{{"all effects", every_effect}};
  const auto without = [&](const std::string& effect, auto leave_out) {
    EffectSet rest = every_effect;
    leave_out(rest);
    all.push_back({"without " + effect, rest});
  };
  without("friction",
          [](EffectSet& e) { e.friction = e.rotation = e.tangential_spring = false, e.rolling = Rolling::none; });
  without("tangential spring", [](EffectSet& e) { e.tangential_spring = false; });
  without("rotation", [](EffectSet& e) { e.rotation = false, e.rolling = Rolling::none; });
  without("rolling", [](EffectSet& e) { e.rolling = Rolling::none; });
  without("cohesion", [](EffectSet& e) { e.cohesion = false; });
  without("polydisperse", [](EffectSet& e) { e.polydisperse = false; });
  without("drag", [](EffectSet& e) { e.drag = false; });
  without("motion", [](EffectSet& e) { e.motion = false; });
  EffectSet few{.motion = true};
  all.push_back({"normal contact alone, its own kernel", few});
  EffectSet usual{.friction = true, .rotation = true, .damping = true, .motion = true};
  all.push_back({"friction, rotation and damping, their own kernel", usual});
  all.push_back({"friction, rotation and damping, kernel of all effects", usual, true});
  return all;
}

}  // namespace
}  // namespace vibrosow

int main() {
  using namespace vibrosow;
  constexpr int rounds = 7;
  const std::vector<Case> all = cases();
  std::vector<std::vector<double>> costs(all.size()), ratios(all.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < all.size(); ++k) {
      costs[k].push_back(cost(all[k]));
      ratios[k].push_back(costs[0].back() / costs[k].back());
    }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  fmt::print("case,ns_per_grain_step,added_by_the_effect_ns,all_effects_take_times_as_long,least,most\n");
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_price = all[k].name.starts_with("without");
    fmt::print("\"{}\",{:.2f},{},{:.2f},{:.2f},{:.2f}\n", all[k].name, median(costs[k]),
               is_price ? fmt::format("{:.2f}", median(costs[0]) - median(costs[k])) : "", median(ratios[k]),
               *std::ranges::min_element(ratios[k]), *std::ranges::max_element(ratios[k]));
  }
}
