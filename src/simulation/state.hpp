#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compute/stop_request.hpp"
#include "contact/contact_state.hpp"
#include "contact/kernels.hpp"
#include "grains/grains.hpp"
#include "grains/random.hpp"
#include "plan/model.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Scaled derivatives h^n / n! of one coordinate, n = 2 .. 5, by grain (Nordsieck form).
using HigherDerivatives = std::array<std::vector<double>, 4>;

/// What a scheme keeps from step to step.
struct IntegratorState {
  // Accelerations at the beginning of the next step; of clumps in 3D `alpha` is the torque, N m, but for gear5.
  std::vector<double> ax, ay, alpha;
  HigherDerivatives of_x{}, of_y{}, of_angle{};    // gear5 only
  std::vector<double> az{}, alpha_x{}, alpha_y{};  // the same in 3D
  HigherDerivatives of_z{}, of_angle_x{}, of_angle_y{};
  std::array<std::vector<double>, 4> quaternion_rate{};  // 1/s, of clumps in 3D; this and the next gear5 only
  std::array<HigherDerivatives, 4> of_quaternion{};
  double wall_power = 0;                      // W, at the beginning of the next step
  double wall_work = 0, gross_wall_work = 0;  // J; sizes summed
};

/// The vessels as they are driven, and their walls.
struct VesselState {
  std::vector<std::optional<VesselMotion>> motion;  // by vessel
  std::vector<Eigen::Vector2d> shift;               // m, by vessel, added to the motion's displacement
  std::vector<char> removed;                        // by wall: whether it is gone, as a gate that opened
  std::vector<char> closed_by_hand;                 // by wall: a gate that was closed from outside, whatever its time
  double placed_at = 0;                             // s, for which the walls were placed last
};

struct CounterState {
  struct Passage {
    bool counted = false;
    int hole = 0;  // passed; 0: none, it fell beside the tray
    double x = 0;  // m, where
    double z = 0;  // m, in 3D
  };
  std::vector<Passage> passages;  // by grain
  std::vector<char> below;        // by grain: whether it is under the floor
};

/// A seed that is to be put in, its place apart.
struct DrawnSeed {
  int lot = 0;
  double size = 1;  // of its lot's diameter
  Turn turned{};    // in the lab
};

struct FeederState {
  /// The rain into one vessel so far.
  struct Shower {
    Random random;
    std::int64_t arrived = 0;   // of those due
    std::int64_t withheld = 0;  // of these, while the vessel was tipped over
    std::int64_t most_waiting = 0;
    double most_waiting_at = 0;       // s
    std::optional<DrawnSeed> next{};  // that waits; none: not drawn
  };
  Random random;
  std::vector<std::optional<DrawnSeed>> missing;  // by vessel: the next of what is missing; none: not drawn
  std::vector<Shower> showers;                    // by vessel
  std::string warning;                            // that more than a quarter of a fill was missing, and since when
};

struct GuardState {
  double max_relative_overlap = 0;
  ToleratedViolations let_pass{};
  // When there was first something to let pass (s): a deep contact, a stride, energy made by the numerics.
  double deep_since = -1, strides_since = -1, energy_since = -1;
  double most_made = 0;  // energy made by the numerics, the largest fraction of that in play
  std::optional<std::string> stop_reason;
  bool has_energy = false;
  double lowest = 0;   // J, of what can only fall
  double in_play = 0;  // J, largest kinetic + elastic energy up to then
  double first_potential = 0;
};

struct RecorderState {
  std::uint64_t taken = 0;             // of the record's times
  std::vector<Eigen::Vector3d> start;  // m, by id: where a grain was put in; 0 across in 2D
};

/// Everything of a run that changes from step to step. Two simulations of the same model and state go on alike, to the
/// last bit; lists, box trees and caches are made from it.
struct SimulationState {
  double time = 0;  // s
  std::int64_t step = 0;
  bool started = false;  // whether the first accelerations are known
  Grains grains;
  IntegratorState integrator{};
  ContactState contacts{};
  ContactStatistics statistics{};
  VesselState vessels{};
  CounterState counter{};
  FeederState feeder;
  GuardState guard{};
  RecorderState recorder{};
  Run run{};  // what has come of it so far
};

/// What a model's grains are kept in, with none in it.
Grains no_grains(const Model& model);

/// A model's fill in place, at rest in the lab or with its vessel. Throws InputError where it does not fit, or two
/// vessels' fills and walls are in each other's way; Interrupted where `stop` is set. A grain that the program placed
/// wrongly is the guard's reason to stop before the first step.
SimulationState starting_state(const Model& model, std::uint64_t random_seed, StopRequest stop = {});

/// The same with grains placed by the caller, whatever they overlap.
SimulationState starting_state(const Model& model, std::uint64_t random_seed, Grains grains);

}  // namespace vibrosow
