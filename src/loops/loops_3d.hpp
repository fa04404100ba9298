#pragma once

#include <cstddef>

#include "compute/instruction_set.hpp"
#include "loops/grain_force.hpp"
#include "loops/grain_loops.hpp"

namespace vibrosow {

/// What drives balls in 3D: w F + g - drag w v and w T, with w = 1/m and 1/J.
struct Drive3d {
  const GrainVector *force, *torque;
  PerGrain per_mass, per_inertia;
  double gravity_x, gravity_y, gravity_z, drag;  // m/s2, kg/s
};

/// Velocities (x, y, z) and their rates; without rotation the spins and theirs are null.
struct Rates3d {
  double *v[3], *omega[3], *a[3], *alpha[3];
};

/// Coordinates x, y, z: m, or of velocities and spins m/s and rad/s.
struct Coordinates {
  const double *x, *y, *z;
};

/// Where kernels read how balls lie and move: a row a ball.
struct BallRows {
  GrainVector* places;
  BallMotion* motions;
};

/// Loops over all balls in 3D, compiled for one instruction set, beside those of GrainLoops that know nothing of
/// dimensions.
struct Loops3d {
  /// Places, or velocities and spins, of which x, y and z lie apart, side by side. Without rotation `spin` is null.
  void (*places_to_rows)(std::size_t n, const Coordinates& places, GrainVector* rows);
  void (*motions_to_rows)(std::size_t n, const Coordinates& velocity, const Coordinates& spin, BallMotion* rows);
  /// `predict` of GrainLoops, of places (x, y, z), velocities and spins; what comes out goes to the rows as well.
  void (*predict)(std::size_t n, double dt, double* const (&places)[3], const Rates3d& rates, const BallRows& rows);
  /// As in GrainLoops.
  void (*accelerate)(std::size_t n, const Drive3d& drive, const Rates3d& rates);
  void (*correct)(std::size_t n, double dt, const Drive3d& drive, const Rates3d& rates);
  bool (*any_moved)(std::size_t n, const Coordinates& now, const double (&shift)[3], const Coordinates& was,
                    const Coordinates& speed, double elapsed, double limit);
  bool (*any_faster)(std::size_t n, const double* vx, const double* vy, const double* vz, double limit);
  /// The grains are moved by `shift_x` and `shift_z`.
  std::size_t (*near_pairs)(std::size_t n, const int* grain, const int* partner, const float* speed,
                            const Coordinates& at, double shift_x, double shift_z, PerGrain radius, double margin,
                            double lasts, int* near_grain, int* near_partner);
};

/// Throws std::logic_error where it is not available. All null in a program for the plane alone.
const Loops3d& loops_3d(InstructionSet set);

}  // namespace vibrosow
