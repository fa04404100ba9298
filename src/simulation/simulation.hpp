#pragma once

#include <memory>
#include <optional>

#include "plan/effects.hpp"
#include "result/run.hpp"
#include "simulation/counter.hpp"
#include "simulation/feeder.hpp"
#include "simulation/guard.hpp"
#include "simulation/integrator.hpp"
#include "simulation/recorder.hpp"

namespace vibrosow {

/// How a simulation is set up beside its scene.
struct SimulationSetup {
  double dt;  // s
  std::uint64_t random_seed = 1;
  Eigen::Vector2d gravity{0, -standard_gravity};  // m/s2
  EffectSet effects{};                            // the kernels to run with; at least those the scene calls for
  NeighbourMargins margins{};
  bool insisted_on_step = false;
  // These change the time of a run, never its result.
  InstructionSet instructions = best_instruction_set();
  int threads = 1;
  bool profile = false;  // whether Run::phase_times are taken
};

/// The grains of a scene in motion, step by step.
class Simulation {
 public:
  Simulation(const Scene& scene, Grains grains, const SimulationSetup& setup);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// One step; false once the guard has stopped the run, or a pause has ended it (run.end_after_pause).
  bool step();
  void steps(std::int64_t count);

  double time() const { return s_.time; }
  Grains& grains() { return grains_; }
  const Grains& grains() const { return grains_; }
  ForceField& field() { return field_; }
  const ForceField& field() const { return field_; }
  const Guard& guard() const { return guard_; }
  const ContactStatistics& statistics() const { return s_.statistics; }

  /// What has come of it so far.
  Run result() const;

 private:
  void count();
  void take_out();
  void wrap();
  void note_lost(std::int64_t grains);
  void open_gates();
  void feed(bool top_up, bool rain);
  void note_whether_dry();
  void end_after_pause();
  void take_out_flagged(const std::vector<char>& removed);

  Scene scene_;
  Grains grains_;
  Execution execution_;
  ForceField field_;
  Integration s_;
  StepFunction advance_;
  Counter counter_;
  Feeder feeder_;
  Guard guard_;
  std::optional<Recorder> recorder_;
  Run run_;
  double next_gate_ = 0;  // s, when the next gate opens
  std::int64_t steps_per_look_, steps_per_removal_, steps_per_feed_;
};

/// The grains of a scene where they start, at rest in the lab or with the tray.
Grains starting_grains(const Scene& scene, std::uint64_t random_seed, const EffectSet& effects);

/// Throws InputError when two grains, or a grain and a wall, overlap by more than the guard's warning allows.
void refuse_overlapping_start(const Scene& scene, const Grains& grains);

}  // namespace vibrosow
