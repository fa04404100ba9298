// How time and memory grow with a bed: the published tray (48 layers of 8 mm discs, 9 Hz, 1 cm, friction by springs,
// restitution 0.5, eps = 1e-4 r), as long as the number of grains asks for; in 3D balls in 16 layers, 20 across. CSV
// on stdout, one row for a number of grains and of threads: 1000 steps to shake in, then as many as are timed.
//     growth [MOST GRAINS [space]]
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string_view>

#include "plan/step_plan.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

constexpr double diameter = 8e-3;

Scene tray_of(int grains, bool is_3d) {
  const int layers = is_3d ? 16 : 48, across = is_3d ? 20 : 1;
  Scene scene;
  scene.lots = {{"grain", diameter, 0.6e-3, is_3d ? Shape::ball : Shape::disc, 1.0}};
  if (is_3d) scene.space = Space::three_dimensional, scene.tray.depth = (across + 0.6) * diameter;
  scene.contact.shell_compression = 1e-4;
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.tray.name = "tray";
  scene.tray.length = diameter * (grains / layers / across + 12);
  scene.tray.height = 2 * layers * diameter;
  scene.tray.fill = Fill{grains, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 2;
  return scene;
}

double seconds_since(std::chrono::steady_clock::time_point from) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

/// Memory that the process holds, bytes (Linux).
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0;
  statm >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void print_row(int grains, int threads, bool is_3d) {
  const Scene scene = tray_of(grains, is_3d);
  malloc_trim(0);  // what earlier rows have given back is not to be had for nothing
  const double before = resident_bytes();
  const auto started = std::chrono::steady_clock::now();
  Simulation simulation(prepare(scene), 1, {.threads = threads});
  const double start = seconds_since(started);
  simulation.steps(1000);
  const std::int64_t timed = std::max<std::int64_t>(200, 20'000'000 / grains);
  const auto from = std::chrono::steady_clock::now();
  simulation.steps(timed);
  const double time = seconds_since(from);
  const Run run = simulation.result();
  fmt::print("{},{},{:.2f},{:.0f},{:.1f},{:.2f}\n", grains, threads, 1e9 * time / static_cast<double>(timed) / grains,
             (resident_bytes() - before) / grains, 1e9 * start / grains,
             static_cast<double>(run.force_evaluations) / static_cast<double>(run.grain_steps));
  std::fflush(stdout);
}

}  // namespace
}  // namespace vibrosow

int main(int argc, char** argv) {
  fmt::print("grains,threads,ns_per_grain_step,bytes_per_grain,start_ns_per_grain,contacts_per_grain_step\n");
  const int most = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
  const bool is_3d = argc > 2 && std::string_view(argv[2]) == "space";
  for (const int grains : {1000, 2400, 5000, 10000, 20000, 50000, 100000, 300000, 1000000})
    for (const int threads : {1, 2})
      if (grains <= most) vibrosow::print_row(grains, threads, is_3d);
}
