// Compiled for each instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include "loops/loops_3d.hpp"

#include <type_traits>

#include "compute/compress.hpp"
#include "compute/four.hpp"
#include "loops/rows.hpp"

namespace vibrosow::inline VIBROSOW_ISA {
namespace {

void places_to_rows(std::size_t n, const Coordinates& places, GrainVector* rows) {
  to_rows(n, places.x, places.y, places.z, [rows](std::size_t i) { return rows + i; });
}

void motions_to_rows(std::size_t n, const Coordinates& velocity, const Coordinates& spin, BallMotion* rows) {
  to_rows(n, velocity.x, velocity.y, velocity.z, [rows](std::size_t i) { return &rows[i].velocity; });
  if (spin.x) to_rows(n, spin.x, spin.y, spin.z, [rows](std::size_t i) { return &rows[i].spin; });
}

template <bool spins>
[[gnu::always_inline]] inline void predict_all(std::size_t n, double dt, double* const (&places)[3],
                                               const Rates3d& rates, const BallRows& rows) {
  const double half = 0.5 * dt;
  const auto move = [dt, half](auto& x, auto& v, const auto& a) {
    v += half * a;
    x += dt * v;
  };
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Four place[4]{}, velocity[4]{}, spin[4]{};
    for (int axis = 0; axis < 3; ++axis) {
      Four a;
      load(place[axis], places[axis] + i), load(velocity[axis], rates.v[axis] + i), load(a, rates.a[axis] + i);
      move(place[axis], velocity[axis], a);
      store(place[axis], places[axis] + i), store(velocity[axis], rates.v[axis] + i);
      if constexpr (spins) {
        load(spin[axis], rates.omega[axis] + i), load(a, rates.alpha[axis] + i);
        spin[axis] += half * a;
        store(spin[axis], rates.omega[axis] + i);
      }
    }
    transpose(place), transpose(velocity), transpose(spin);
    for (std::size_t k = 0; k < 4; ++k) {
      *reinterpret_cast<Four*>(rows.places + i + k) = place[k];
      *reinterpret_cast<Four*>(&rows.motions[i + k].velocity) = velocity[k];
      if constexpr (spins) *reinterpret_cast<Four*>(&rows.motions[i + k].spin) = spin[k];
    }
  }
  for (; i < n; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      move(places[axis][i], rates.v[axis][i], rates.a[axis][i]);
      if constexpr (spins) rates.omega[axis][i] += half * rates.alpha[axis][i];
    }
    rows.places[i] = {places[0][i], places[1][i], places[2][i], 0};
    rows.motions[i].velocity = {rates.v[0][i], rates.v[1][i], rates.v[2][i], 0};
    if constexpr (spins) rows.motions[i].spin = {rates.omega[0][i], rates.omega[1][i], rates.omega[2][i], 0};
  }
}

void predict(std::size_t n, double dt, double* const (&places)[3], const Rates3d& rates, const BallRows& rows) {
  (rates.omega[0] ? predict_all<true> : predict_all<false>)(n, dt, places, rates, rows);
}

/// Calls `take(v, a, now)` for the velocities of four balls or of one, their old rates and those by which they are
/// driven `ahead` seconds on, drag apart all the time.
template <bool polydisperse, bool drags, class Take>
[[gnu::always_inline]] inline void for_each_rate(std::size_t n, const GrainVector* force, PerGrain per,
                                                 const double (&gravity)[3], double drag, double ahead,
                                                 double* const (&v)[3], double* const (&a)[3], Take take) {
  const auto drive = [&](const auto& pushes, const auto& per_mass, auto& velocity, auto& rate, int axis) {
    auto now = pushes * per_mass + gravity[axis];
    if constexpr (drags) {
      const auto fall_off = drag * per_mass;
      now = (now - fall_off * velocity) / (1 + ahead * fall_off);
    }
    take(velocity, rate, now);
  };
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Four rows[4];
    for (std::size_t k = 0; k < 4; ++k) rows[k] = *reinterpret_cast<const Four*>(force + i + k);
    transpose(rows);
    Four per_mass = Four{} + per.same;
    if constexpr (polydisperse) load(per_mass, per.each + i);
    for (int axis = 0; axis < 3; ++axis) {
      Four velocity, rate;
      load(velocity, v[axis] + i), load(rate, a[axis] + i);
      drive(rows[axis], per_mass, velocity, rate, axis);
      store(velocity, v[axis] + i), store(rate, a[axis] + i);
    }
  }
  for (; i < n; ++i) {
    const double pushes[3] = {force[i].x, force[i].y, force[i].z};
    const double per_mass = polydisperse ? per.each[i] : per.same;
    for (int axis = 0; axis < 3; ++axis) drive(pushes[axis], per_mass, v[axis][i], a[axis][i], axis);
  }
}

template <class Take>
[[gnu::always_inline]] inline void drive_all(std::size_t n, const Drive3d& drive, double ahead, const Rates3d& rates,
                                             Take take) {
  const auto one = [&](const GrainVector* force, PerGrain per, const double(&gravity)[3], double drag,
                       double* const(&v)[3], double* const(&a)[3]) {
    const auto with = [&](auto polydisperse) {
      drag == 0 ? for_each_rate<polydisperse, false>(n, force, per, gravity, drag, ahead, v, a, take)
                : for_each_rate<polydisperse, true>(n, force, per, gravity, drag, ahead, v, a, take);
    };
    per.each ? with(std::true_type()) : with(std::false_type());
  };
  one(drive.force, drive.per_mass, {drive.gravity_x, drive.gravity_y, drive.gravity_z}, drive.drag, rates.v, rates.a);
  if (rates.omega[0]) one(drive.torque, drive.per_inertia, {0, 0, 0}, 0, rates.omega, rates.alpha);
}

void accelerate(std::size_t n, const Drive3d& drive, const Rates3d& rates) {
  drive_all(n, drive, 0, rates, [](auto& /*v*/, auto& a, const auto& now) { a = now; });
}

void correct(std::size_t n, double dt, const Drive3d& drive, const Rates3d& rates) {
  const double half = 0.5 * dt;
  drive_all(n, drive, half, rates, [half](auto& v, auto& a, const auto& now) {
    v += half * now;
    a = now;
  });
}

bool any_moved(std::size_t n, const Coordinates& now, const double (&shift)[3], const Coordinates& was,
               const Coordinates& speed, double elapsed, double limit) {
  const double *x = now.x, *y = now.y, *z = now.z, *was_x = was.x, *was_y = was.y, *was_z = was.z;
  const double *speed_x = speed.x, *speed_y = speed.y, *speed_z = speed.z;
  const double shift_x = shift[0], shift_y = shift[1], shift_z = shift[2], limit2 = limit * limit;
  int far = 0;
#pragma omp simd reduction(| : far)
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = x[i] - shift_x - was_x[i] - elapsed * speed_x[i];
    const double dy = y[i] - shift_y - was_y[i] - elapsed * speed_y[i];
    const double dz = z[i] - shift_z - was_z[i] - elapsed * speed_z[i];
    far |= dx * dx + dy * dy + dz * dz > limit2 ? 1 : 0;
  }
  return far != 0;
}

bool any_faster(std::size_t n, const double* vx, const double* vy, const double* vz, double limit) {
  const double limit2 = limit * limit;
  int fast = 0;
#pragma omp simd reduction(| : fast)
  for (std::size_t i = 0; i < n; ++i) fast |= vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i] <= limit2 ? 0 : 1;
  return fast != 0;
}

template <class Radius>
[[gnu::always_inline]] inline std::size_t near_pairs_of(std::size_t n, const int* grain, const int* partner,
                                                        const float* speed, const Coordinates& at, double shift_x,
                                                        double shift_z, Radius radius, double margin, double lasts,
                                                        int* near_grain, int* near_partner) {
  constexpr std::size_t block = 256;
  unsigned char flags[block + 16];
  const double *x = at.x, *y = at.y, *z = at.z;
  std::size_t near = 0;
  for (std::size_t from = 0; from < n; from += block) {
    const int count = static_cast<int>(n - from < block ? n - from : block);
    const int *a = grain + from, *b = partner + from;
    const float* apart = speed + from;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const std::size_t i = static_cast<std::size_t>(a[k]), j = static_cast<std::size_t>(b[k]);
      const double dx = x[j] - (x[i] + shift_x), dy = y[j] - y[i], dz = z[j] - (z[i] + shift_z);
      const double limit = radius(i) + margin + radius(j) + lasts * static_cast<double>(apart[k]);
      flags[k] = dx * dx + dy * dy + dz * dz < limit * limit ? 1 : 0;
    }
    near += static_cast<std::size_t>(
        compress(flags, count, Kept<int>{a, near_grain + near}, Kept<int>{b, near_partner + near}));
  }
  return near;
}

std::size_t near_pairs(std::size_t n, const int* grain, const int* partner, const float* speed, const Coordinates& at,
                       double shift_x, double shift_z, PerGrain radius, double margin, double lasts, int* near_grain,
                       int* near_partner) {
  const auto with = [&](auto radius_of) {
    return near_pairs_of(n, grain, partner, speed, at, shift_x, shift_z, radius_of, margin, lasts, near_grain,
                         near_partner);
  };
  if (radius.each) return with([=](std::size_t i) { return radius.each[i]; });
  return with([=](std::size_t) { return radius.same; });
}

}  // namespace

extern const Loops3d loops_3d;
const Loops3d loops_3d{places_to_rows, motions_to_rows, predict,    accelerate,
                       correct,        any_moved,       any_faster, near_pairs};

}  // namespace vibrosow::inline VIBROSOW_ISA
