// What `check` foresees a run to take, against what it takes: CPU time of one core. A scene that would take longer than
// the given seconds is cut short to about that, and the prediction is of the shortened one. CSV on stdout.
// Usage: predicted_time SECONDS SEEDER...
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "input/read_scene.hpp"
#include "plan/model.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "study/predicted_cost.hpp"

namespace vibrosow {
namespace {

double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void compare(const std::filesystem::path& file, double most) {
  Scene scene = read_scene(file);
  const double whole = scene.run.duration;
  if (step_refused(scene.numerics, prepare(scene).step)) {
    fmt::print("{},{:g},,,,,,,,,step refused\n", file.stem().string(), whole);
    return;
  }
  PredictedCost predicted = predict_cost(scene);
  if (predicted.seconds() > most) {
    scene.run.duration *= most / predicted.seconds();
    scene.run.measure_from = 0;
    predicted = predict_cost(scene);
  }
  const double from = cpu_time();
  const Run run = simulate(scene);
  const double taken = cpu_time() - from;
  const auto grain_steps = static_cast<double>(run.grain_steps);
  fmt::print("{},{:g},{:.4g},{:.4g},{:.4g},{:.3f},{:.4g},{:.4g},{:.3g},{:.3g},{:.3f}\n", file.stem().string(), whole,
             scene.run.duration, predicted.grain_steps, grain_steps, predicted.grain_steps / grain_steps,
             predicted.ns_per_grain_step, 1e9 * taken / grain_steps, predicted.seconds(), taken,
             predicted.seconds() / taken);
  std::fflush(stdout);
}

}  // namespace
}  // namespace vibrosow

int main(int count, char** arguments) {
  if (count < 3) {
    fmt::print(stderr, "usage: predicted_time SECONDS SEEDER...\n");
    return 2;
  }
  fmt::print(
      "seeder,duration_s,run_s,predicted_grain_steps,grain_steps,grain_steps_ratio,predicted_ns,ns,predicted_s,cpu_s,"
      "time_ratio\n");
  try {
    for (int k = 2; k < count; ++k) vibrosow::compare(arguments[k], std::atof(arguments[1]));
  } catch (const vibrosow::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
