// Compiled for each instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include "compute/space_loops.hpp"

#include <type_traits>

#include "compute/compress.hpp"

namespace vibrosow::inline VIBROSOW_ISA {
namespace {

/// Calls `take(v, a, now)` for one velocity of each ball, its old rate and that by which it is driven now.
template <bool polydisperse, bool drags, class Take>
[[gnu::always_inline]] inline void for_each_rate(std::size_t n, const double* force, PerGrain per, double gravity,
                                                 double drag, double* v, double* a, Take take) {
  const double* each = per.each;
  const double same = per.same;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double per_mass = polydisperse ? each[i] : same;
    double now = force[4 * i] * per_mass + gravity;
    if constexpr (drags) now -= drag * per_mass * v[i];
    take(v[i], a[i], now);
  }
}

template <class Take>
[[gnu::always_inline]] inline void drive_all(std::size_t n, const SpaceDrive& drive, const SpaceRates& rates,
                                             Take take) {
  const auto one = [&](const double* force, PerGrain per, double gravity, double drag, double* v, double* a) {
    const auto with = [&](auto polydisperse) {
      drag == 0 ? for_each_rate<polydisperse, false>(n, force, per, gravity, drag, v, a, take)
                : for_each_rate<polydisperse, true>(n, force, per, gravity, drag, v, a, take);
    };
    per.each ? with(std::true_type()) : with(std::false_type());
  };
  const double gravity[3] = {drive.gravity_x, drive.gravity_y, drive.gravity_z};
  for (int axis = 0; axis < 3; ++axis)
    one(&drive.force->x + axis, drive.per_mass, gravity[axis], drive.drag, rates.v[axis], rates.a[axis]);
  if (!rates.omega[0]) return;
  for (int axis = 0; axis < 3; ++axis)
    one(&drive.torque->x + axis, drive.per_inertia, 0, 0, rates.omega[axis], rates.alpha[axis]);
}

void accelerate(std::size_t n, const SpaceDrive& drive, const SpaceRates& rates) {
  drive_all(n, drive, rates, [](double /*v*/, double& a, double now) { a = now; });
}

void correct(std::size_t n, double dt, const SpaceDrive& drive, const SpaceRates& rates) {
  drive_all(n, drive, rates, [half = 0.5 * dt](double& v, double& a, double now) {
    v += half * (now - a);
    a = now;
  });
}

bool any_moved(std::size_t n, const Coordinates& now, const double (&shift)[3], const Coordinates& was, double limit) {
  const double *x = now.x, *y = now.y, *z = now.z, *was_x = was.x, *was_y = was.y, *was_z = was.z;
  const double shift_x = shift[0], shift_y = shift[1], shift_z = shift[2], limit2 = limit * limit;
  int far = 0;
#pragma omp simd reduction(| : far)
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = x[i] - shift_x - was_x[i], dy = y[i] - shift_y - was_y[i], dz = z[i] - shift_z - was_z[i];
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
                                                        const Coordinates& at, double shift_x, double shift_z,
                                                        Radius radius, double margin, int* near_grain,
                                                        int* near_partner) {
  constexpr std::size_t block = 256;
  unsigned char flags[block + 16];
  const double *x = at.x, *y = at.y, *z = at.z;
  std::size_t near = 0;
  for (std::size_t from = 0; from < n; from += block) {
    const int count = static_cast<int>(n - from < block ? n - from : block);
    const int *a = grain + from, *b = partner + from;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const std::size_t i = static_cast<std::size_t>(a[k]), j = static_cast<std::size_t>(b[k]);
      const double dx = x[j] - (x[i] + shift_x), dy = y[j] - y[i], dz = z[j] - (z[i] + shift_z);
      const double limit = radius(i) + margin + radius(j);
      flags[k] = dx * dx + dy * dy + dz * dz < limit * limit ? 1 : 0;
    }
    near += static_cast<std::size_t>(
        compress(flags, count, Kept<int>{a, near_grain + near}, Kept<int>{b, near_partner + near}));
  }
  return near;
}

std::size_t near_pairs(std::size_t n, const int* grain, const int* partner, const Coordinates& at, double shift_x,
                       double shift_z, PerGrain radius, double margin, int* near_grain, int* near_partner) {
  if (radius.each)
    return near_pairs_of(
        n, grain, partner, at, shift_x, shift_z, [=](std::size_t i) { return radius.each[i]; }, margin, near_grain,
        near_partner);
  return near_pairs_of(
      n, grain, partner, at, shift_x, shift_z, [=](std::size_t) { return radius.same; }, margin, near_grain,
      near_partner);
}

}  // namespace

extern const SpaceLoops loops_in_space;
const SpaceLoops loops_in_space{accelerate, correct, any_moved, any_faster, near_pairs};

}  // namespace vibrosow::inline VIBROSOW_ISA
