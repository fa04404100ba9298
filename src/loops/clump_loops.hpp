#pragma once

#include <cstddef>

#include "compute/instruction_set.hpp"
#include "loops/grain_force.hpp"

namespace vibrosow {

/// How clumps in 3D lie and turn, by arrays.
struct ClumpTurning {
  double* quaternion[4];  // w, x, y, z, of unit length
  double* spin[3];        // rad/s, in the lab
  const int* lot;
  const double* inverse_inertia;  // 1/(kg m2), of the smallest principal moment; 0: it is kept from turning
  const double* moments[3];       // by lot: principal moments over the smallest
};

/// Where clumps in 3D are and how they move, by arrays.
struct ClumpMotion {
  const double *place[3], *velocity[3];  // m, m/s
  const double* quaternion[4];
  const double* spin[3];  // rad/s; null without rotation
};

/// The balls of clumps, clump by clump: those of the i-th are the numbers first[i] .. first[i + 1] - 1.
struct ClumpBalls {
  const std::size_t* first;
  const double *own_x, *own_y, *own_z;  // m, from the clump's centre of mass along its own axes
};

/// What becomes of them: arms from the clumps' centres in the lab, places (m) and motions; places also by arrays.
struct PlacedBalls {
  GrainVector *arm, *place;
  BallMotion* motion;
  double *x, *y, *z;
};

/// Forces (N) and torques (N m) of balls about their own centres, and of their clumps; without torques null.
struct ClumpForces {
  const GrainVector *on_balls, *torques_on_balls;
  GrainVector *force, *torque;
};

/// Loops over clumps in 3D, compiled for one instruction set; those of `n` clumps begin with the first of all
/// arrays, others take the clumps [from, to).
struct ClumpLoops {
  /// Velocity Verlet: how they lie at the end of a step, and the spins there by the angular momentum in its middle.
  /// `torque`: at its beginning, N m.
  void (*predict)(std::size_t n, double dt, const ClumpTurning& clumps, const double* const (&torque)[3]);
  /// Spins at the end of a step, by the torques there, which are `kept`.
  void (*correct)(std::size_t n, double dt, const ClumpTurning& clumps, const GrainVector* torque,
                  double* const (&kept)[3]);
  /// Balls moved with their clumps: x + R c, v + omega x R c, R by the clump's quaternion.
  void (*place)(std::size_t from, std::size_t to, const ClumpMotion& clumps, const ClumpBalls& balls,
                const PlacedBalls& placed);
  /// Sums of a clump's balls, torques with those of the forces' arms, about its centre of mass.
  void (*gather)(std::size_t from, std::size_t to, const std::size_t* first, const GrainVector* arm,
                 const ClumpForces& forces);
};

/// Throws std::logic_error where it is not available. All null in a program for the plane alone.
const ClumpLoops& clump_loops(InstructionSet set);

}  // namespace vibrosow
