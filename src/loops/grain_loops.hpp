#pragma once

#include <cstddef>

#include "compute/instruction_set.hpp"
#include "loops/grain_force.hpp"

namespace vibrosow {

/// One value for all grains, or one each.
struct PerGrain {
  const double* each;  // null: all have `same`
  double same;
};

/// What drives the grains: w F + g - drag w v and w T, with w = 1/m and 1/J.
struct Drive {
  const GrainForce* force;
  PerGrain per_mass, per_inertia;
  double gravity_x, gravity_y, drag;  // m/s2, kg/s
};

/// Velocities and their rates; without rotation `omega` and `alpha` are null.
struct Rates {
  double *vx, *vy, *omega, *ax, *ay, *alpha;
};

/// Loops over all grains, compiled for one instruction set. Every array has `n` entries.
struct GrainLoops {
  /// v += dt/2 a, x += dt v: velocities in the middle of a step, positions at its end. No positions: x = null.
  void (*predict)(std::size_t n, double dt, double* x, double* v, const double* a);

  /// Rates as they are driven.
  void (*accelerate)(std::size_t n, const Drive& drive, const Rates& rates);

  /// The same at the end of a step, and v += dt/2 a: velocities there, which drag acts on, from those in its middle.
  void (*correct)(std::size_t n, double dt, const Drive& drive, const Rates& rates);

  /// Taylor's series for position, velocity and higher derivatives (gear5), one step on; x = null as above.
  void (*gear_predict)(std::size_t n, double dt, double* x, double* v, double* q2, double* q3, double* q4,
                       const double* q5);
  /// Fractions of what the acceleration `a` missed, in the order of the derivatives.
  void (*gear_correct)(std::size_t n, double dt, const double* a, double* x, double* v, double* q2, double* q3,
                       double* q4, double* q5);

  /// Whether a grain is farther than `limit` (m) from where it was and would be `elapsed` (s) later at its speed (m/s),
  /// `x` and `y` taken relative to (shift_x, shift_y).
  bool (*any_moved)(std::size_t n, const double* x, const double* y, double shift_x, double shift_y,
                    const double* was_x, const double* was_y, const double* speed_x, const double* speed_y,
                    double elapsed, double limit);

  /// Whether a speed is beyond `limit` (m/s), or no number.
  bool (*any_faster)(std::size_t n, const double* vx, const double* vy, double limit);

  /// 1 for each grain whose sine x + cosine y is below `level`, or that has `before` set; else 0.
  void (*flag_below)(std::size_t n, const double* x, const double* y, double sine, double cosine, double level,
                     const char* before, char* flags);

  /// Copies the pairs k in [0, n) nearer than r_i + r_j + margin (m), and `lasts` (s) times `speed` (m/s, of each pair)
  /// more, to the front of `near`, in order, and returns how many; `grain`s are moved by `shift` along x. `near_grain`
  /// and `near_partner` have n + 16 places.
  std::size_t (*near_pairs)(std::size_t n, const int* grain, const int* partner, const float* speed, const double* x,
                            const double* y, double shift, PerGrain radius, double margin, double lasts,
                            int* near_grain, int* near_partner);
};

/// Throws std::logic_error where it is not available.
const GrainLoops& grain_loops(InstructionSet set);

}  // namespace vibrosow
