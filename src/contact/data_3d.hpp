#pragma once

#include <array>
#include <vector>

#include "contact/pair_block.hpp"
#include "loops/grain_force.hpp"

// Plain data between the simulation and the kernels of balls in 3D, as pair_block.hpp has it for the plane.

namespace vibrosow {

/// Where and how fast the balls are when forces are wanted: what a pair needs of a ball lies side by side, to be
/// fetched at once. `row_place` stands for `place` of the first grain of each pair, as `row_x` of Motion does.
struct Motion3d {
  const GrainVector *place, *row_place;
  const BallMotion* motion;
};

/// Where the forces of a block of pairs go.
struct PairResult3d {
  GrainVector *forces, *torques;  // N, N m; without rotation no torque is added
  int first_own;

  int contacts;
  LawMetrics metrics;
  int foreign_count;
  ForeignForce3d foreign[pair_block_size];
};

using PairKernel3d = void (*)(const GrainSurfaces&, const Motion3d&, const PairList&, PairRange,
                              const ContactParameters&, const ContactStep&, ContactHistories&, PairResult3d&);

/// One vector for each contact.
struct VectorColumns {
  std::vector<double> x, y, z;

  void resize(std::size_t count) { x.resize(count), y.resize(count), z.resize(count); }
};

/// Balls that touch walls: of each array the first `count` places count.
struct WallContacts3d {
  int count = 0;
  std::vector<int> candidate, grain;
  std::vector<double> distance;            // m, from the centre to the wall's nearest point
  VectorColumns normal;                    // towards that point
  VectorColumns wall_velocity, wall_spin;  // m/s, rad/s: of the wall's material there; the spin on the step's mean
  VectorColumns mean_wall_velocity;        // m/s, on the step's mean
  VectorColumns force, torque;             // N, N m, on the grain; torques without rotation unset
};

using WallKernel3d = LawMetrics (*)(const GrainSurfaces&, const Motion3d&, const ContactParameters&, const ContactStep&,
                                    ContactHistories&, WallContacts3d&);

/// What is compiled for each instruction set.
struct VectorKernels3d {
  PairKernel3d pair;
  WallKernel3d wall;
};

/// By index of `compiled_effects`.
using LawKernels3d = std::array<VectorKernels3d, compiled_effects.size()>;

}  // namespace vibrosow
