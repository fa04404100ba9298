#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "simulation/motion_change.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {

/// What keeps a run from going on as another scene.
enum class Obstacle {
  seeds,      // others, or other contacts
  accuracy,   // or any other value of the numerics
  holes,      // more or fewer
  vessels,    // anything else of them
  motion,     // not harmonic before or after, of another ramp, or one that stops
  stiffness,  // the other shake needs stiffer seeds
  plan,       // of the run; or the program refuses the scene, or it is in 3D
};
std::string_view name_of(Obstacle obstacle);

/// The running simulation's state, for one of `model` to go on with, which has the same seeds, contacts and walls (by
/// their names). Bed, contacts and time go on; what has been counted and what the guard saw begin anew. Goes on to the
/// last bit where the models are the same. The time is rounded to whole steps of the model.
SimulationState carried_over(const Simulation& running, const Model& model);

/// Whether no seed would lie deeper in a wall than the guard warns of, if the tray were this one, of walls of the same
/// names: a seed that already lies deeper may lie as deep.
bool has_room(const Simulation& running, const Vessel& tray);

/// A run whose tray may be shaken otherwise, and its holes widened, narrowed and moved, while it goes on. The shake
/// changes over one period (MotionChange). A hole moves at the ends of strokes, when the tray rests, each time as far
/// as no seed is in the way of its floor. From each change on the run counts anew, measures after as long a time as its
/// plan's `measure_from`, and goes on for its plan's duration. Seeds stay as soft as the accuracy level made them for
/// the first shake.
class LiveRun {
 public:
  /// Throws as `prepare_to_run` and `starting_state` do.
  LiveRun(Scene scene, std::uint64_t random_seed);

  /// Takes the run to another scene, now and in the steps to come, in place of what it still waited for; or says what
  /// keeps it from that, and does nothing.
  std::optional<Obstacle> change(const Scene& wanted);

  /// As Simulation::step.
  bool step();

  enum class Waiting {
    for_nothing,
    for_motion,  // until the change of motion before is over
    for_holes,   // until they are where they are wanted
    given_up,    // seeds were in the way of a hole's new floor for ten shakes
  };
  Waiting waiting() const { return waiting_; }
  bool is_waiting() const { return waiting_ == Waiting::for_motion || waiting_ == Waiting::for_holes; }
  /// How many times it has become another run, and when it last did (s); at first 0.
  int changes() const { return changes_; }
  double since() const { return since_; }

  /// Another object after each change.
  Simulation& simulation() { return *simulation_; }
  const Simulation& simulation() const { return *simulation_; }

 private:
  Waiting lacking() const;
  bool is_too_soft_for(const Vessel& tray) const;
  void wait_until_given_up();
  void take_up();
  void take_up_motion();
  void take_up_holes();
  bool is_at_stroke_end() const;
  void go_on(const Vessel& tray, const std::optional<VesselMotion>& course);

  Scene scene_;   // what runs, as it was asked for
  Scene wanted_;  // what is to run
  Waiting waiting_ = Waiting::for_nothing;
  double latest_ = 0;          // s, when it gives up
  double changing_until_ = 0;  // s, the motion
  double since_ = 0;
  int changes_ = 0;
  Numerics numerics_;    // with the accuracy level written out
  double planned_step_;  // s, for what runs
  std::optional<Simulation> simulation_;
};

}  // namespace vibrosow
