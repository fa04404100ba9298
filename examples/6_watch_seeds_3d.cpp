// Runs a tray as balls in 3D, and watches how many of its seeds lie in the front half of its depth.
#include <cstdio>
#include <vibrosow/simulation.hpp>

int main(int, char** arguments) {
  using namespace vibrosow::api;
  const double depth = 0.02;  // m
  const Scene scene = Scene::read(arguments[1], {"space=3d", "tray.depth=2 cm", "tray.motion.direction=[1, 0, 0.5]",
                                                 "run.duration=0.1 s", "run.measure_from=0 s"});
  Simulation simulation(scene);
  for (Status status = Status::running; status == Status::running;) {
    status = simulation.advance_to(simulation.time() + 0.02);
    std::size_t in_front = 0;
    const std::vector<Grain> grains = simulation.grains();
    for (const Grain& grain : grains) {
      if (grain.z < -0.02 || grain.z > depth + 0.02) return 1;  // the tray moves by 1 cm at most
      in_front += grain.z < 0.5 * depth;
    }
    std::printf("%.2f s: %zu of %zu seeds in the front half\n", simulation.time(), in_front, grains.size());
    if (in_front == 0 || in_front == grains.size()) return 1;
  }
  return 0;
}
