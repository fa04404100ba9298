#include "simulation/simulate.hpp"

#include <chrono>
#include <numeric>

#include "plan/effects.hpp"
#include "plan/step_plan.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

constexpr std::int64_t steps_between_looks = 256;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Run simulate(const Scene& scene, const SimulationOptions& options) {
  const Clock::time_point started = Clock::now();
  const StepPlan plan = plan_step(scene);
  if (const auto refused = step_refused(scene, plan)) throw InputError(*refused);
  const EffectSet effects = effects_of(scene);
  Grains grains = starting_grains(scene, options.random_seed, effects);
  refuse_overlapping_start(scene, grains);
  Simulation simulation(scene, std::move(grains),
                        {.dt = plan.dt,
                         .random_seed = options.random_seed,
                         .effects = effects,
                         .margins = {},
                         .insisted_on_step = plan.too_long,
                         .threads = options.threads,
                         .profile = options.profile});
  bool interrupted = false;
  Clock::time_point measuring = Clock::now();
  for (std::int64_t done = 0; done < plan.steps && !interrupted && simulation.step();) {
    if (simulation.time() <= scene.run.measure_from) measuring = Clock::now();
    if (++done % steps_between_looks != 0) continue;
    interrupted = options.interrupt && options.interrupt->load();
    if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(plan.steps));
  }
  Run run = simulation.result();
  if (interrupted) run.status = RunStatus::interrupted;
  run.wall_time = seconds_since(started);
  run.measured_wall_time = run.end_time > scene.run.measure_from ? seconds_since(measuring) : 0;
  if (run.phase_times)  // packing came before the stopwatch was started
    run.phase_times->front() += run.wall_time - std::accumulate(run.phase_times->begin(), run.phase_times->end(), 0.0);
  return run;
}

}  // namespace vibrosow
