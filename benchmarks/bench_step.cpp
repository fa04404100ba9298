// Whole steps, broadphase included, of the published tray: 2400 grains of 8 mm in 50 cm, 9 Hz, 1 cm, three holes of 24
// mm, friction 0.3 (sliding, or held by springs), restitution 0.5, velocity Verlet at its planned step.
// items_per_second is grain-steps per second on one core. Beside them the parts of a step on the tray as it is at 0.3 s
// (an evaluation of the forces, a search with Box2D, both lists renewed) and a whole run from its start, in grains or
// grain-steps per second. In 3D: the closed tray with a depth of 165 mm and 20000 balls in some sixteen layers.
#include <benchmark/benchmark.h>

#include "plan/step_plan.hpp"
#include "simulation/simulate.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

Scene published_tray(double shell_compression) {
  Scene scene;
  scene.lots = {{"grain", 8e-3, 0.6e-3, Shape::disc, 1.0}};
  scene.contact.shell_compression = shell_compression;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.tray.name = "tray";
  scene.tray.length = 0.5;
  scene.tray.height = 0.45;
  scene.tray.holes = {{0.125, 0.024}, {0.25, 0.024}, {0.375, 0.024}};
  scene.tray.fill = Fill{2400, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 2;
  return scene;
}

Scene tray_3d() {
  Scene scene = published_tray(1e-4);
  scene.space = Space::three_dimensional;
  scene.lots = {{"grain", 8e-3, 0.6e-3, Shape::ball, 1.0}};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.depth = 0.165;
  scene.tray.holes.clear();
  scene.tray.fill = Fill{20000, Packing::layers, 1e-3, false};
  return scene;
}

EffectSet effects_of_tray(bool spring) {
  return {.friction = true, .rotation = true, .damping = true, .motion = true, .tangential_spring = spring};
}

/// Runs to 0.3 s, past the first impacts, then times the steps up to `until`, again and again from the start.
void time_steps(benchmark::State& state, const Model& model, double until) {
  std::int64_t grain_steps = 0, searches = 0, prunes = 0, contacts = 0, steps = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Simulation simulation(model, 1);
    while (simulation.time() < 0.3) simulation.step();
    const Run before = simulation.result();
    const Neighbours& neighbours = simulation.field().neighbours();
    const std::int64_t searches_before = neighbours.searches(), prunes_before = neighbours.prunes();
    state.ResumeTiming();
    while (simulation.time() < until) simulation.step();
    state.PauseTiming();
    const Run after = simulation.result();
    grain_steps += after.grain_steps - before.grain_steps;
    contacts += after.force_evaluations - before.force_evaluations;
    steps += after.steps - before.steps;
    searches += neighbours.searches() - searches_before;
    prunes += neighbours.prunes() - prunes_before;
    state.ResumeTiming();
  }
  state.SetItemsProcessed(grain_steps);
  state.counters["contacts_per_grain_step"] = static_cast<double>(contacts) / static_cast<double>(grain_steps);
  state.counters["steps_per_search"] = static_cast<double>(steps) / static_cast<double>(searches);
  state.counters["steps_per_prune"] = static_cast<double>(steps) / static_cast<double>(prunes);
}

void steps_of_the_published_tray(benchmark::State& state, double shell_compression, EffectSet effects) {
  Scene scene = published_tray(shell_compression);
  if (effects.tangential_spring) scene.contact.friction_model = FrictionModel::spring;
  time_steps(state, prepare(scene, effects), 0.4);
}

void steps_of_a_tray_3d(benchmark::State& state) {
  time_steps(state, prepare(tray_3d()), 0.31);
}

BENCHMARK_CAPTURE(steps_of_the_published_tray, stiff_spring, 1e-4, effects_of_tray(true))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(steps_of_the_published_tray, stiff, 1e-4, effects_of_tray(false))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(steps_of_the_published_tray, soft_spring, 1e-2, effects_of_tray(true))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(steps_of_the_published_tray, soft, 1e-2, effects_of_tray(false))->Unit(benchmark::kMillisecond);
BENCHMARK(steps_of_a_tray_3d)->Unit(benchmark::kMillisecond);

/// Calls `part(simulation)` again and again on the stiff tray with springs at 0.3 s; an item is a grain.
template <class Part>
void part_of_a_step(benchmark::State& state, Part part) {
  Scene scene = published_tray(1e-4);
  scene.contact.friction_model = FrictionModel::spring;
  Simulation simulation(prepare(scene, effects_of_tray(true)), 1);
  while (simulation.time() < 0.3) simulation.step();
  for (auto _ : state) part(simulation);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(simulation.grains().size()));
}

void forces(benchmark::State& state) {
  ContactStatistics statistics;
  part_of_a_step(state, [&](Simulation& simulation) { simulation.field().evaluate(0.3, {}, statistics); });
}

void search(benchmark::State& state) {
  PairList pairs;
  std::vector<WallCandidate> walls;
  const Ranges one{1, [](const auto& work) { work(0); }};
  part_of_a_step(state, [&](Simulation& simulation) {
    const Grains& grains = simulation.grains();
    simulation.field().neighbours().broadphase().find(grains, simulation.field().walls().poses(),
                                                      reaches_at_rest(grains), 0.016, one, pairs, walls);
  });
}

void renew_both_lists(benchmark::State& state) {
  part_of_a_step(state, [](Simulation& simulation) { simulation.field().grains_wrapped(); });
}

void whole_run(benchmark::State& state) {
  Scene scene = published_tray(1e-4);
  scene.run.duration = 0.1;
  std::int64_t grain_steps = 0;
  for (auto _ : state) grain_steps += simulate(scene).grain_steps;
  state.SetItemsProcessed(grain_steps);
}

BENCHMARK(forces)->Unit(benchmark::kMicrosecond);
BENCHMARK(search)->Unit(benchmark::kMicrosecond);
BENCHMARK(renew_both_lists)->Unit(benchmark::kMicrosecond);
BENCHMARK(whole_run)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vibrosow

BENCHMARK_MAIN();
