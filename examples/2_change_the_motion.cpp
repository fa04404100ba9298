// Shakes a tray at 9 Hz, from 0.5 s on at 12 Hz, and compares the seeds that leave before and after.
#include <cstdio>
#include <vibrosow/simulation.hpp>

int main(int, char** arguments) {
  using namespace vibrosow::api;
  const Scene scene = Scene::read(arguments[1], {"run.duration=0.8 s", "run.measure_from=0 s"});
  Simulation simulation(scene);
  simulation.advance_to(0.5);
  const std::size_t before = simulation.events_since(0).size();
  simulation.set_motion({.amplitude = 0.01, .frequency = 12});
  simulation.advance_to(scene.duration());
  const std::size_t after = simulation.events_since(before).size();
  std::printf("%zu seeds in 0.5 s at 9 Hz, %zu in 0.3 s at 12 Hz\n", before, after);
  return before > 0 && after > 0 ? 0 : 1;
}
