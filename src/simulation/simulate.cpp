#include "simulation/simulate.hpp"

#include <chrono>
#include <numeric>

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
  return run_model(prepare_to_run(scene), options);
}

Run run_model(const Model& model, const SimulationOptions& options) {
  const Clock::time_point started = Clock::now();
  Simulation simulation(model, options.from ? *options.from : starting_state(model, options.random_seed),
                        {.threads = options.threads, .profile = options.profile});
  const auto checkpoint = [&](const Simulation& now) { options.on_checkpoint(now.state()); };
  if (options.on_checkpoint && options.checkpoint_every > 0) simulation.watch(options.checkpoint_every, checkpoint);
  const double measure_from = model.scene.run.measure_from;
  bool interrupted = false;
  Clock::time_point measuring = Clock::now();
  for (std::int64_t done = 0; !simulation.at_end() && !interrupted && simulation.step();) {
    if (simulation.time() <= measure_from) measuring = Clock::now();
    if (++done % steps_between_looks != 0) continue;
    interrupted = options.interrupt && options.interrupt->load();
    if (options.progress)
      options.progress(static_cast<double>(simulation.state().step) / static_cast<double>(model.step.steps));
  }
  if (interrupted && options.on_checkpoint) checkpoint(simulation);
  Run run = simulation.result();
  if (interrupted) run.status = RunStatus::interrupted;
  run.wall_time = seconds_since(started);
  run.measured_wall_time = run.end_time > measure_from ? seconds_since(measuring) : 0;
  if (run.phase_times)  // packing came before the stopwatch was started
    run.phase_times->front() += run.wall_time - std::accumulate(run.phase_times->begin(), run.phase_times->end(), 0.0);
  return run;
}

}  // namespace vibrosow
