#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "plan/model.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"
#include "simulation/state.hpp"

namespace vibrosow {

class Simulation;

/// Called at a run's beginning, then every so often (s, simulated), and at its end.
struct Observer {
  double every;
  std::function<void(Simulation&)> observe;
};

struct SimulationOptions {
  std::uint64_t random_seed = 1;
  int threads = 1;                               // that share the run's loops; the result is the same for any number
  bool profile = false;                          // whether Run::phase_times are taken
  const std::atomic<bool>* interrupt = nullptr;  // looked at now and then, also while the fill is packed and the first
                                                 // neighbours are sought; true ends the run as interrupted
  std::function<void(double fraction_done)> progress{};  // called now and then with 0..1, in the simulating thread

  std::vector<Observer> observers{};             // none of them changes the run
  std::function<void(Simulation&)> on_record{};  // where snapshots were just taken

  std::optional<SimulationState> from{};                        // to go on from; none: the scene's start
  double checkpoint_every = 0;                                  // s, simulated; 0: never
  std::function<bool()> checkpoint_now{};                       // asked now and then
  std::function<void(const SimulationState&)> on_checkpoint{};  // then, and where the run is interrupted
};

/// Runs a scene to its end. Same scene and random seed: the same Run to the last bit, but for wall_time. Throws
/// InputError when the fill does not fit its vessel, grains overlap at the start, or the step is too long and not
/// insisted on.
Run simulate(const Scene& scene, const SimulationOptions& options = {});

/// The same of a scene that is prepared.
Run run_model(const Model& model, const SimulationOptions& options = {});

}  // namespace vibrosow
