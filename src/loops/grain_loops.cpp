// Compiled for each instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include "loops/grain_loops.hpp"

#include <type_traits>

#include "compute/compress.hpp"

namespace vibrosow::inline VIBROSOW_ISA {
namespace {

void predict(std::size_t n, double dt, double* x, double* v, const double* a) {
  const double half = 0.5 * dt;
  if (x) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) {
      v[i] += half * a[i];
      x[i] += dt * v[i];
    }
  } else {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) v[i] += half * a[i];
  }
}

/// Calls `take(v, a, now)` for each velocity of each grain, its old rate and that by which it is driven `ahead` seconds
/// on, drag apart all the time.
template <bool polydisperse, bool drags, bool rotation, class Take>
[[gnu::always_inline]] inline void for_each_rate(std::size_t n, const Drive& drive, double ahead, const Rates& rates,
                                                 Take take) {
  const GrainForce* force = drive.force;
  const double *each_per_mass = drive.per_mass.each, *each_per_inertia = drive.per_inertia.each;
  const double same_per_mass = drive.per_mass.same, same_per_inertia = drive.per_inertia.same;
  const double gx = drive.gravity_x, gy = drive.gravity_y, drag = drive.drag;
  double *vx = rates.vx, *vy = rates.vy, *omega = rates.omega, *ax = rates.ax, *ay = rates.ay, *alpha = rates.alpha;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double per_mass = polydisperse ? each_per_mass[i] : same_per_mass;
    double now_x = force[i].fx * per_mass + gx, now_y = force[i].fy * per_mass + gy;
    if constexpr (drags) {
      const double fall_off = drag * per_mass, later = 1 + ahead * fall_off;
      now_x = (now_x - fall_off * vx[i]) / later, now_y = (now_y - fall_off * vy[i]) / later;
    }
    take(vx[i], ax[i], now_x), take(vy[i], ay[i], now_y);
    if constexpr (rotation)
      take(omega[i], alpha[i], force[i].torque * (polydisperse ? each_per_inertia[i] : same_per_inertia));
  }
}

template <class Take>
[[gnu::always_inline]] inline void drive_all(std::size_t n, const Drive& drive, double ahead, const Rates& rates,
                                             Take take) {
  const auto with = [&](auto polydisperse, auto drags) {
    rates.omega ? for_each_rate<polydisperse, drags, true>(n, drive, ahead, rates, take)
                : for_each_rate<polydisperse, drags, false>(n, drive, ahead, rates, take);
  };
  const std::true_type yes;
  const std::false_type no;
  if (drive.per_mass.each)
    drive.drag == 0 ? with(yes, no) : with(yes, yes);
  else
    drive.drag == 0 ? with(no, no) : with(no, yes);
}

void accelerate(std::size_t n, const Drive& drive, const Rates& rates) {
  drive_all(n, drive, 0, rates, [](double /*v*/, double& a, double now) { a = now; });
}

void correct(std::size_t n, double dt, const Drive& drive, const Rates& rates) {
  const double half = 0.5 * dt;
  drive_all(n, drive, half, rates, [half](double& v, double& a, double now) {
    v += half * now;
    a = now;
  });
}

bool any_moved(std::size_t n, const double* x, const double* y, double shift_x, double shift_y, const double* was_x,
               const double* was_y, const double* speed_x, const double* speed_y, double elapsed, double limit) {
  const double limit2 = limit * limit;
  int far = 0;
#pragma omp simd reduction(| : far)
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = x[i] - shift_x - was_x[i] - elapsed * speed_x[i];
    const double dy = y[i] - shift_y - was_y[i] - elapsed * speed_y[i];
    far |= dx * dx + dy * dy > limit2 ? 1 : 0;
  }
  return far != 0;
}

bool any_faster(std::size_t n, const double* vx, const double* vy, double limit) {
  const double limit2 = limit * limit;
  int fast = 0;
#pragma omp simd reduction(| : fast)
  for (std::size_t i = 0; i < n; ++i) fast |= vx[i] * vx[i] + vy[i] * vy[i] <= limit2 ? 0 : 1;
  return fast != 0;
}

void flag_below(std::size_t n, const double* x, const double* y, double sine, double cosine, double level,
                const char* before, char* flags) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i)
    flags[i] = static_cast<char>((sine * x[i] + cosine * y[i] < level ? 1 : 0) | before[i]);
}

template <class Radius>
[[gnu::always_inline]] inline std::size_t near_pairs_of(std::size_t n, const int* grain, const int* partner,
                                                        const float* speed, const double* x, const double* y,
                                                        double shift, Radius radius, double margin, double lasts,
                                                        int* near_grain, int* near_partner) {
  constexpr std::size_t block = 256;
  unsigned char flags[block + 16];
  std::size_t near = 0;
  for (std::size_t from = 0; from < n; from += block) {
    const int count = static_cast<int>(n - from < block ? n - from : block);
    const int *a = grain + from, *b = partner + from;
    const float* apart = speed + from;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const std::size_t i = static_cast<std::size_t>(a[k]), j = static_cast<std::size_t>(b[k]);
      const double dx = x[j] - (x[i] + shift), dy = y[j] - y[i];
      const double limit = radius(i) + margin + radius(j) + lasts * static_cast<double>(apart[k]);
      flags[k] = dx * dx + dy * dy < limit * limit ? 1 : 0;
    }
    near += static_cast<std::size_t>(
        compress(flags, count, Kept<int>{a, near_grain + near}, Kept<int>{b, near_partner + near}));
  }
  return near;
}

std::size_t near_pairs(std::size_t n, const int* grain, const int* partner, const float* speed, const double* x,
                       const double* y, double shift, PerGrain radius, double margin, double lasts, int* near_grain,
                       int* near_partner) {
  const auto with = [&](auto radius_of) {
    return near_pairs_of(n, grain, partner, speed, x, y, shift, radius_of, margin, lasts, near_grain, near_partner);
  };
  if (radius.each) return with([=](std::size_t i) { return radius.each[i]; });
  return with([=](std::size_t) { return radius.same; });
}

template <bool with_position>
void gear_predict_each(std::size_t n, double dt, double* x, double* v, double* q2, double* q3, double* q4,
                       const double* q5) {
  const double per_dt = 1 / dt;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double a = q2[i], b = q3[i], c = q4[i], d = q5[i];
    if constexpr (with_position) x[i] += dt * v[i] + (a + b + c + d);
    v[i] += per_dt * (2 * a + 3 * b + 4 * c + 5 * d);
    q2[i] = a + 3 * b + 6 * c + 10 * d;
    q3[i] = b + 4 * c + 10 * d;
    q4[i] = c + 5 * d;
  }
}

template <bool with_position>
void gear_correct_each(std::size_t n, double dt, const double* acceleration, double* x, double* v, double* q2,
                       double* q3, double* q4, double* q5) {
  constexpr double fraction0 = 3.0 / 16, fraction1 = 251.0 / 360, fraction3 = 11.0 / 18, fraction4 = 1.0 / 6,
                   fraction5 = 1.0 / 60;
  const double half_dt2 = 0.5 * dt * dt, v_fraction = fraction1 / dt;
  // In free flight the derivatives die out by a factor a step: below this (m) they are nothing, and the denormal
  // numbers they would become take a hundred times as long.
  constexpr double nothing = 1e-100;
  const auto or_nothing = [](double q) { return q > nothing || q < -nothing ? q : 0.0; };
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double now = half_dt2 * acceleration[i], missed = now - q2[i];
    if constexpr (with_position) x[i] += fraction0 * missed;
    v[i] += v_fraction * missed;
    q2[i] = now;
    q3[i] = or_nothing(q3[i] + fraction3 * missed);
    q4[i] = or_nothing(q4[i] + fraction4 * missed);
    q5[i] = or_nothing(q5[i] + fraction5 * missed);
  }
}

void gear_predict(std::size_t n, double dt, double* x, double* v, double* q2, double* q3, double* q4,
                  const double* q5) {
  (x ? gear_predict_each<true> : gear_predict_each<false>)(n, dt, x, v, q2, q3, q4, q5);
}

void gear_correct(std::size_t n, double dt, const double* a, double* x, double* v, double* q2, double* q3, double* q4,
                  double* q5) {
  (x ? gear_correct_each<true> : gear_correct_each<false>)(n, dt, a, x, v, q2, q3, q4, q5);
}

}  // namespace

extern const GrainLoops loops;
const GrainLoops loops{predict,   accelerate, correct,    gear_predict, gear_correct,
                       any_moved, any_faster, flag_below, near_pairs};

}  // namespace vibrosow::inline VIBROSOW_ISA
