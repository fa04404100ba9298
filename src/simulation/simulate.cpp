#include "simulation/simulate.hpp"

#include <chrono>
#include <ctime>
#include <numeric>

#include "scene/measuring_window.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

constexpr std::int64_t steps_between_looks = 256, grain_steps_between_looks = 1000000;  // some 0.03 s

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of this process, all its threads, s.
double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A run that was interrupted before its first step.
Run not_begun(const Model& model, const SimulationOptions& options) {
  Run run;
  run.status = RunStatus::interrupted;
  run.random_seed = options.random_seed;
  run.dt = model.step.dt;
  return run;
}

Run run_to_end(Simulation& simulation, const SimulationOptions& options) {
  const Model& model = simulation.model();
  const auto checkpoint = [&](const Simulation& now) { options.on_checkpoint(now.state()); };
  if (options.on_checkpoint && options.checkpoint_every > 0) simulation.watch(options.checkpoint_every, checkpoint);
  for (const Observer& one : options.observers) one.observe(simulation), simulation.watch(one.every, one.observe);
  std::size_t recorded = 0;
  const auto look_at_records = [&] {
    const std::size_t snapshots = simulation.state().run.snapshots.size();
    if (snapshots > recorded && options.on_record) options.on_record(simulation);
    recorded = snapshots;
  };
  look_at_records();
  const double measure_from = measuring_window(model.scene).from;
  bool interrupted = false;
  std::optional<double> measured_since;     // of the processor's time
  std::int64_t steps = 0, grain_steps = 0;  // since the last look
  while (!simulation.at_end() && !interrupted && simulation.step()) {
    look_at_records();
    if (!measured_since && simulation.time() > measure_from) measured_since = processor_time();
    grain_steps += static_cast<std::int64_t>(simulation.grains().size());
    if (++steps < steps_between_looks && grain_steps < grain_steps_between_looks) continue;
    steps = grain_steps = 0;
    interrupted = StopRequest(options.interrupt).is_set();
    if (!interrupted && options.checkpoint_now && options.checkpoint_now()) checkpoint(simulation);
    if (options.progress)
      options.progress(static_cast<double>(simulation.state().step) / static_cast<double>(model.step.steps));
  }
  look_at_records();  // of a step that ended the run
  for (const Observer& one : options.observers) one.observe(simulation);
  if (interrupted && options.on_checkpoint) checkpoint(simulation);
  Run run = simulation.result();
  if (interrupted) run.status = RunStatus::interrupted, run.goes_on = false;
  if (measured_since) run.measured_cpu_time = processor_time() - *measured_since;
  return run;
}

Run begin_and_run(const Model& model, const SimulationOptions& options) {
  const StopRequest stop(options.interrupt);
  try {
    Simulation simulation(model, options.from ? *options.from : starting_state(model, options.random_seed, stop),
                          {.threads = options.threads, .profile = options.profile, .stop = stop});
    return run_to_end(simulation, options);
  } catch (const Interrupted&) {
    return not_begun(model, options);
  }
}

}  // namespace

Run simulate(const Scene& scene, const SimulationOptions& options) {
  return run_model(prepare_to_run(scene), options);
}

Run run_model(const Model& model, const SimulationOptions& options) {
  const Clock::time_point started = Clock::now();
  Run run = begin_and_run(model, options);
  run.wall_time = seconds_since(started);
  if (run.phase_times)  // packing came before the stopwatch was started
    run.phase_times->front() += run.wall_time - std::accumulate(run.phase_times->begin(), run.phase_times->end(), 0.0);
  return run;
}

}  // namespace vibrosow
