// Compiled for each instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include "loops/clump_loops.hpp"

#include "loops/rows.hpp"
#include "loops/turning_clump.hpp"

namespace vibrosow::inline VIBROSOW_ISA {
namespace {

/// For loops in vectors: the pointers by value, so that the compiler knows that no store changes them.
struct Turning {
  [[gnu::always_inline]] bool turns(std::size_t i) const { return of.inverse_inertia[i] > 0; }
  [[gnu::always_inline]] Vector3 spin(std::size_t i) const { return {of.spin[0][i], of.spin[1][i], of.spin[2][i]}; }
  [[gnu::always_inline]] TurningClump clump(std::size_t i) const {
    const int lot = of.lot[i];
    const double per = of.inverse_inertia[i];
    return {{of.quaternion[0][i], of.quaternion[1][i], of.quaternion[2][i], of.quaternion[3][i]},
            {of.moments[0][lot] / per, of.moments[1][lot] / per, of.moments[2][lot] / per}};
  }
  [[gnu::always_inline]] void set(std::size_t i, const Orientation& q) const {
    set(i, of.quaternion[0], q.w), set(i, of.quaternion[1], q.x);
    set(i, of.quaternion[2], q.y), set(i, of.quaternion[3], q.z);
  }
  [[gnu::always_inline]] void set_spin(std::size_t i, const Vector3& spin) const {
    set(i, of.spin[0], spin.x), set(i, of.spin[1], spin.y), set(i, of.spin[2], spin.z);
  }
  /// Of one that can turn.
  [[gnu::always_inline]] void set(std::size_t i, double* values, double now) const {
    values[i] = turns(i) ? now : values[i];
  }

  const ClumpTurning of;
};

// The work on one clump is a function of its own: what is declared within a loop in vectors is kept in memory.

[[gnu::always_inline]] inline void predict_one(const Turning& clumps, std::size_t i, double dt, const Vector3& torque) {
  TurningClump clump = clumps.clump(i);
  const Vector3 momentum = clump.momentum_of(clumps.spin(i)) + (0.5 * dt) * torque;
  clump.turn_freely(momentum, dt);
  clumps.set(i, clump.orientation());
  clumps.set_spin(i, clump.spin_of(momentum));
}

[[gnu::flatten]] void predict(std::size_t n, double dt, const ClumpTurning& of, const double* const (&torque)[3]) {
  const Turning clumps{of};
  const double *torque_x = torque[0], *torque_y = torque[1], *torque_z = torque[2];
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) predict_one(clumps, i, dt, {torque_x[i], torque_y[i], torque_z[i]});
}

[[gnu::always_inline]] inline void correct_one(const Turning& clumps, std::size_t i, double dt, const GrainVector& now,
                                               double& kept_x, double& kept_y, double& kept_z) {
  const Vector3 torque{now.x, now.y, now.z};
  clumps.set_spin(i, clumps.spin(i) + clumps.clump(i).spin_of((0.5 * dt) * torque));
  kept_x = clumps.turns(i) ? now.x : kept_x;
  kept_y = clumps.turns(i) ? now.y : kept_y;
  kept_z = clumps.turns(i) ? now.z : kept_z;
}

[[gnu::flatten]] void correct(std::size_t n, double dt, const ClumpTurning& of, const GrainVector* torque,
                              double* const (&kept)[3]) {
  const Turning clumps{of};
  double *kept_x = kept[0], *kept_y = kept[1], *kept_z = kept[2];
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) correct_one(clumps, i, dt, torque[i], kept_x[i], kept_y[i], kept_z[i]);
}

/// sum += a x b. (By reference: how vectors are returned differs between instruction sets.)
[[gnu::always_inline]] inline void add_cross_product(Four& sum, const Four& a, const Four& b) {
  const Four a_from_y = __builtin_shufflevector(a, a, 1, 2, 0, 3), a_from_z = __builtin_shufflevector(a, a, 2, 0, 1, 3),
             b_from_y = __builtin_shufflevector(b, b, 1, 2, 0, 3), b_from_z = __builtin_shufflevector(b, b, 2, 0, 1, 3);
  sum += a_from_y * b_from_z - a_from_z * b_from_y;
}

[[gnu::always_inline]] inline Four& four(GrainVector& row) {
  return reinterpret_cast<Four&>(row);
}
[[gnu::always_inline]] inline const Four& four(const GrainVector& row) {
  return reinterpret_cast<const Four&>(row);
}

/// How a few clumps lie and move, each one's numbers side by side.
constexpr std::size_t at_once = 64;
struct LyingClump {
  GrainVector axis_x, axis_y, axis_z, place, velocity, spin;
};

[[gnu::flatten]] void lie(std::size_t from, std::size_t n, const ClumpMotion& clumps, LyingClump* lying) {
  double axes[9][at_once];
  const double *w = clumps.quaternion[0] + from, *x = clumps.quaternion[1] + from, *y = clumps.quaternion[2] + from,
               *z = clumps.quaternion[3] + from;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const Axes own = axes_of({w[i], x[i], y[i], z[i]});
    axes[0][i] = own.x.x, axes[1][i] = own.x.y, axes[2][i] = own.x.z;
    axes[3][i] = own.y.x, axes[4][i] = own.y.y, axes[5][i] = own.y.z;
    axes[6][i] = own.z.x, axes[7][i] = own.z.y, axes[8][i] = own.z.z;
  }
  to_rows(n, axes[0], axes[1], axes[2], [lying](std::size_t i) { return &lying[i].axis_x; });
  to_rows(n, axes[3], axes[4], axes[5], [lying](std::size_t i) { return &lying[i].axis_y; });
  to_rows(n, axes[6], axes[7], axes[8], [lying](std::size_t i) { return &lying[i].axis_z; });
  const auto rows_of = [&](const double* const(&a)[3], auto row) {
    to_rows(n, a[0] + from, a[1] + from, a[2] + from, row);
  };
  rows_of(clumps.place, [lying](std::size_t i) { return &lying[i].place; });
  rows_of(clumps.velocity, [lying](std::size_t i) { return &lying[i].velocity; });
  if (clumps.spin[0]) rows_of(clumps.spin, [lying](std::size_t i) { return &lying[i].spin; });
}

void place_balls(const LyingClump& clump, std::size_t from, std::size_t to, const ClumpBalls& balls,
                 const PlacedBalls& placed) {
  const Four axis_x = four(clump.axis_x), axis_y = four(clump.axis_y), axis_z = four(clump.axis_z),
             place = four(clump.place), velocity = four(clump.velocity), spin = four(clump.spin);
  for (std::size_t k = from; k < to; ++k) {
    const Four arm = axis_x * balls.own_x[k] + (axis_y * balls.own_y[k] + axis_z * balls.own_z[k]), at = place + arm;
    four(placed.arm[k]) = arm, four(placed.place[k]) = at;
    Four moving = velocity;
    add_cross_product(moving, spin, arm);
    four(placed.motion[k].velocity) = moving, four(placed.motion[k].spin) = spin;
    placed.x[k] = at[0], placed.y[k] = at[1], placed.z[k] = at[2];
  }
}

void place(std::size_t from, std::size_t to, const ClumpMotion& clumps, const ClumpBalls& balls,
           const PlacedBalls& placed) {
  LyingClump lying[at_once]{};
  for (; from < to; from += at_once) {
    const std::size_t n = to - from < at_once ? to - from : at_once;
    lie(from, n, clumps, lying);
    for (std::size_t i = 0; i < n; ++i)
      place_balls(lying[i], balls.first[from + i], balls.first[from + i + 1], balls, placed);
  }
}

void gather(std::size_t from, std::size_t to, const std::size_t* first, const GrainVector* arm,
            const ClumpForces& forces) {
  for (std::size_t i = from; i < to; ++i) {
    Four force{}, torque{};
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
      force += four(forces.on_balls[k]);
      if (!forces.torque) continue;
      add_cross_product(torque, four(arm[k]), four(forces.on_balls[k]));
      if (forces.torques_on_balls) torque += four(forces.torques_on_balls[k]);
    }
    four(forces.force[i]) = force;
    if (forces.torque) four(forces.torque[i]) = torque;
  }
}

}  // namespace

extern const ClumpLoops loops_of_clumps;
const ClumpLoops loops_of_clumps{predict, correct, place, gather};

}  // namespace vibrosow::inline VIBROSOW_ISA
