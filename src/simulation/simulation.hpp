#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plan/model.hpp"
#include "result/frame.hpp"
#include "simulation/counter.hpp"
#include "simulation/feeder.hpp"
#include "simulation/guard.hpp"
#include "simulation/integrator.hpp"
#include "simulation/recorder.hpp"
#include "simulation/state.hpp"

namespace vibrosow {

/// With what a simulation is computed: changes its time and never its result.
struct ComputeOptions {
  NeighbourMargins margins{};
  InstructionSet instructions = best_instruction_set();
  int threads = 1;
  bool profile = false;  // whether Run::phase_times are taken
  StopRequest stop{};    // while the simulation is constructed: throws Interrupted
};

/// The grains of a model in motion, step by step. It can be watched and driven between two steps.
class Simulation {
 public:
  /// From a model's start, or from a state that was saved. Throws as `starting_state` does.
  Simulation(const Model& model, std::uint64_t random_seed, const ComputeOptions& options = {});
  Simulation(Model model, SimulationState state, const ComputeOptions& options = {});
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// One step; false once the guard has stopped the run, or a pause has ended it (run.end_after_pause).
  bool step();
  void steps(std::int64_t count);
  /// Steps up to the first that ends at or after `time` (s), never beyond the run's end; false as `step`.
  bool run_until(double time);

  /// Calls `look` after every step that ends a whole `interval` of simulated time (s; rounded to whole steps, at least
  /// one), in the order in which they were given. A look that drives the simulation does so from the next step on.
  void watch(double interval, std::function<void(Simulation&)> look);

  double time() const { return state_.time; }
  bool at_end() const { return state_.step >= model_.step.steps; }
  const Model& model() const { return model_; }
  const SimulationState& state() const { return state_; }
  const Grains& grains() const { return state_.grains; }
  /// Grains that have left, from the event number `first` on, in the order of steps.
  std::span<const OutflowEvent> events_since(std::size_t first) const;

  /// Another motion for a vessel (0: the tray, 1: the hopper) from now on; it takes the place of the scene's and goes
  /// by the time of the run. Its displacement is moved so that the vessel goes on from where it is. Throws
  /// std::invalid_argument for a vessel there is not, where the old or the new motion turns the vessel, and where a
  /// hopper cannot stand over its periodic tray with it.
  void set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion);

  /// Opens or closes the gate of a hole (1.. from the left) that opens later than 0 in its scene. A gate does not close
  /// on a grain in its way: false, and it stays open. Throws std::invalid_argument for a hole without a gate.
  void open_gate(const std::string& vessel, int hole);
  bool close_gate(const std::string& vessel, int hole);

  /// What has come of it so far.
  Run result() const;

  /// Whether the centre of a grain lies in the hopper, or in an image of it.
  bool is_in_hopper(std::size_t i) const;

  /// The bed and its contacts as they are now.
  Frame frame();

  /// For tests and tools that look deeper, or change what they should not.
  Grains& grains() { return state_.grains; }
  ForceField& field() { return field_; }
  const ForceField& field() const { return field_; }
  const Guard& guard() const { return guard_; }
  const ContactStatistics& statistics() const { return state_.statistics; }

 private:
  struct Watcher {
    std::int64_t every;  // steps
    std::function<void(Simulation&)> look;
  };

  void begin();
  void count();
  void take_out();
  void wrap();
  void note_lost(const std::vector<int>& grains);
  void open_due_gates();
  void open_walls(const std::vector<std::size_t>& walls);
  void find_next_gate();
  std::vector<std::size_t> gate_of(const std::string& vessel, int hole) const;
  bool is_free(std::size_t wall) const;
  void feed(bool top_up, bool rain);
  /// Counted up to so many.
  bool is_in_tray(std::size_t i) const;
  /// Takes the snapshots that are due.
  void record();
  std::int64_t inside_tray(std::int64_t most = std::numeric_limits<std::int64_t>::max()) const;
  void note_what_tray_holds();
  void end_after_pause();
  void take_out_flagged(const std::vector<char>& removed);

  Model model_;
  SimulationState state_;
  Execution execution_;
  ForceField field_;
  Integration s_;
  StepFunction advance_;
  Counter counter_;
  Feeder feeder_;
  Guard guard_;
  std::optional<Recorder> recorder_;
  std::vector<Watcher> watchers_;
  double window_from_;    // s, when measuring begins
  double next_gate_ = 0;  // s, when the next gate opens
  std::int64_t steps_per_look_, steps_per_removal_, steps_per_feed_;
};

}  // namespace vibrosow
