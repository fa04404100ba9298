// Runs the scene whose JSON stands on standard input, with the rooms from a Scene to its Outflow alone, and prints what
// came out to the last bit. Argument: the random seed, 1 without.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <iterator>
#include <string>

#include "outflow/outflow.hpp"
#include "scene/scene_json.hpp"
#include "simulation/simulate.hpp"

int main(int count, char** arguments) try {
  using namespace vibrosow;
  const Scene scene = scene_from_json(std::string(std::istreambuf_iterator<char>(std::cin), {}));
  SimulationOptions options;
  if (count > 1) options.random_seed = std::strtoull(arguments[1], nullptr, 10);
  const Run run = simulate(scene, options);
  for (const OutflowEvent& event : run.events)
    std::printf("%a s, hole %d, grain %lld, x %a m, %a m/s\n", event.time, event.hole,
                static_cast<long long>(event.grain), event.x, event.speed);
  for (const HoleOutflow& row : measure_outflow(scene, run).holes)
    std::printf("hole %s: %lld grains, %a kg/s\n", row.hole.c_str(), static_cast<long long>(row.grains), row.mass_rate);
  std::printf("%lld steps, energy %a %a J\n", static_cast<long long>(run.steps), run.energy.kinetic,
              run.energy.wall_work);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "run_scene: %s\n", error.what());
  return 1;
}
