#include "simulation/integrator.hpp"

#include <cmath>

namespace vibrosow {
namespace {

template <bool rotation_, bool drag_, bool unequal_>
struct BodyEffects {
  static constexpr bool rotation = rotation_, drag = drag_, unequal = unequal_;
};

/// a = F / m + g - (mu / m) v, alpha = T / J, into the arrays of `s`.
template <class Effects>
void accelerations(Integration& s) {
  const Grains& grains = s.grains;
  const std::size_t n = grains.size();
  const double *fx = s.field.forces().fx.data(), *fy = s.field.forces().fy.data();
  const double *vx = grains.vx.data(), *vy = grains.vy.data();
  double *ax = s.ax.data(), *ay = s.ay.data();
  const double gx = s.gravity.x(), gy = s.gravity.y(), drag = s.drag;
  const GrainKind& kind = grains.kinds.front();
  for (std::size_t i = 0; i < n; ++i) {
    const double w = Effects::unequal ? grains.inverse_mass[i] : kind.inverse_mass;
    double a = fx[i] * w + gx, b = fy[i] * w + gy;
    if constexpr (Effects::drag) a -= drag * w * vx[i], b -= drag * w * vy[i];
    ax[i] = a, ay[i] = b;
  }
  if constexpr (Effects::rotation) {
    const double* torque = s.field.forces().torque.data();
    double* alpha = s.alpha.data();
    for (std::size_t i = 0; i < n; ++i)
      alpha[i] = torque[i] * (Effects::unequal ? grains.inverse_inertia[i] : kind.inverse_inertia);
  }
}

void add_scaled(std::vector<double>& to, const std::vector<double>& rate, double factor) {
  double* t = to.data();
  const double* r = rate.data();
  for (std::size_t i = 0; i < to.size(); ++i) t[i] += factor * r[i];
}

/// to = from + factor rate
void set_sum(std::vector<double>& to, const std::vector<double>& from, const std::vector<double>& rate, double factor) {
  double* t = to.data();
  const double *f = from.data(), *r = rate.data();
  for (std::size_t i = 0; i < to.size(); ++i) t[i] = f[i] + factor * r[i];
}

/// a and alpha with every effect the grains have, chosen at run time: for starts.
void accelerations_now(Integration& s, double time, const HistoryAdvance& advance, ContactCensus& census) {
  const Grains& grains = s.grains;
  s.ax.resize(grains.size()), s.ay.resize(grains.size()), s.alpha.resize(grains.omega.size());
  s.field.evaluate(grains, time, advance, census);
  if (grains.rotation)
    grains.unequal ? accelerations<BodyEffects<true, true, true>>(s) : accelerations<BodyEffects<true, true, false>>(s);
  else
    grains.unequal ? accelerations<BodyEffects<false, true, true>>(s)
                   : accelerations<BodyEffects<false, true, false>>(s);
}

void add_wall_work(Integration& s, double work) {
  s.wall_work += work;
  s.gross_wall_work += std::abs(work);
}

double next_time(const Integration& s) {
  return static_cast<double>(s.step + 1) * s.dt;
}

/// Positions and predicted velocities at the end of the step.
void predict(std::vector<double>& x, std::vector<double>& v, const std::vector<double>& a, double dt) {
  double *px = x.data(), *pv = v.data();
  const double *pa = a.data(), half = 0.5 * dt;
  for (std::size_t i = 0; i < x.size(); ++i) {
    px[i] += dt * (pv[i] + half * pa[i]);
    pv[i] += dt * pa[i];
  }
}

template <class Effects>
void velocity_verlet(Integration& s) {
  Grains& grains = s.grains;
  const double half = 0.5 * s.dt;
  predict(grains.x, grains.vx, s.ax, s.dt);
  predict(grains.y, grains.vy, s.ay, s.dt);
  if constexpr (Effects::rotation) {
    if (grains.oriented)
      predict(grains.angle, grains.omega, s.alpha, s.dt);
    else
      add_scaled(grains.omega, s.alpha, s.dt);
  }
  const double power_before = s.wall_power;
  s.field.evaluate(grains, next_time(s), {.trial = s.dt, .commit = s.dt, .present = 0.5}, s.census);

  // v = v_predicted + (a_new - a_old) dt / 2
  std::swap(s.ax, s.x), std::swap(s.ay, s.y), std::swap(s.alpha, s.omega);
  s.ax.resize(grains.size()), s.ay.resize(grains.size()), s.alpha.resize(grains.omega.size());
  accelerations<Effects>(s);
  const auto correct = [half](std::vector<double>& v, const std::vector<double>& now,
                              const std::vector<double>& before) {
    double* pv = v.data();
    const double *a = now.data(), *b = before.data();
    for (std::size_t i = 0; i < v.size(); ++i) pv[i] += half * (a[i] - b[i]);
  };
  correct(grains.vx, s.ax, s.x);
  correct(grains.vy, s.ay, s.y);
  if constexpr (Effects::rotation) correct(grains.omega, s.alpha, s.omega);
  s.wall_power = s.census.wall_power;
  add_wall_work(s, half * (power_before + s.wall_power));
}

template <class Effects>
void rk2_midpoint(Integration& s) {
  Grains& grains = s.grains;
  s.field.evaluate(grains, s.time, {}, s.census);
  accelerations<Effects>(s);
  s.x = grains.x, s.y = grains.y, s.vx = grains.vx, s.vy = grains.vy, s.omega = grains.omega, s.angle = grains.angle;
  const double half = 0.5 * s.dt;
  add_scaled(grains.x, s.vx, half), add_scaled(grains.y, s.vy, half);
  add_scaled(grains.vx, s.ax, half), add_scaled(grains.vy, s.ay, half);
  if constexpr (Effects::rotation) {
    if (grains.oriented) add_scaled(grains.angle, s.omega, half);
    add_scaled(grains.omega, s.alpha, half);
  }

  s.field.evaluate(grains, s.time + half, {.trial = half, .commit = s.dt, .present = 1}, s.census);
  accelerations<Effects>(s);
  set_sum(grains.x, s.x, grains.vx, s.dt), set_sum(grains.y, s.y, grains.vy, s.dt);
  set_sum(grains.vx, s.vx, s.ax, s.dt), set_sum(grains.vy, s.vy, s.ay, s.dt);
  if constexpr (Effects::rotation) {
    if (grains.oriented) set_sum(grains.angle, s.angle, grains.omega, s.dt);
    set_sum(grains.omega, s.omega, s.alpha, s.dt);
  }
  add_wall_work(s, s.dt * s.census.wall_power);
}

/// Taylor's series for position, velocity and higher derivatives, one step on.
template <bool with_position>
void gear_predict(std::size_t n, double dt, double* __restrict x, double* __restrict v, double* __restrict q2,
                  double* __restrict q3, double* __restrict q4, const double* __restrict q5) {
  const double per_dt = 1 / dt;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = q2[i], b = q3[i], c = q4[i], d = q5[i];
    if constexpr (with_position) x[i] += dt * v[i] + (a + b + c + d);
    v[i] += per_dt * (2 * a + 3 * b + 4 * c + 5 * d);
    q2[i] = a + 3 * b + 6 * c + 10 * d;
    q3[i] = b + 4 * c + 10 * d;
    q4[i] = c + 5 * d;
  }
}

/// Shares of what the acceleration missed, in the order of the derivatives.
template <bool with_position>
void gear_correct(std::size_t n, double dt, const double* __restrict acceleration, double* __restrict x,
                  double* __restrict v, double* __restrict q2, double* __restrict q3, double* __restrict q4,
                  double* __restrict q5) {
  constexpr double share0 = 3.0 / 16, share1 = 251.0 / 360, share3 = 11.0 / 18, share4 = 1.0 / 6, share5 = 1.0 / 60;
  const double half_dt2 = 0.5 * dt * dt, v_share = share1 / dt;
  // In free flight the derivatives die out by a factor a step: below this (m) they are nothing, and the denormal
  // numbers they would become take a hundred times as long.
  constexpr double nothing = 1e-100;
  const auto or_nothing = [](double q) { return std::abs(q) > nothing ? q : 0; };
  for (std::size_t i = 0; i < n; ++i) {
    const double now = half_dt2 * acceleration[i], missed = now - q2[i];
    if constexpr (with_position) x[i] += share0 * missed;
    v[i] += v_share * missed;
    q2[i] = now;
    q3[i] = or_nothing(q3[i] + share3 * missed);
    q4[i] = or_nothing(q4[i] + share4 * missed);
    q5[i] = or_nothing(q5[i] + share5 * missed);
  }
}

void gear_predict(std::vector<double>& x, std::vector<double>& v, HigherDerivatives& q, double dt) {
  (x.empty() ? gear_predict<false> : gear_predict<true>)(v.size(), dt, x.data(), v.data(), q[0].data(), q[1].data(),
                                                         q[2].data(), q[3].data());
}

void gear_correct(std::vector<double>& x, std::vector<double>& v, HigherDerivatives& q, const std::vector<double>& a,
                  double dt) {
  (x.empty() ? gear_correct<false> : gear_correct<true>)(v.size(), dt, a.data(), x.data(), v.data(), q[0].data(),
                                                         q[1].data(), q[2].data(), q[3].data());
}

template <class Effects>
void gear5(Integration& s) {
  Grains& grains = s.grains;
  gear_predict(grains.x, grains.vx, s.of_x, s.dt);
  gear_predict(grains.y, grains.vy, s.of_y, s.dt);
  if constexpr (Effects::rotation) gear_predict(grains.angle, grains.omega, s.of_angle, s.dt);
  const double power_before = s.wall_power;
  s.field.evaluate(grains, next_time(s), {.trial = s.dt, .commit = s.dt, .present = 0.5}, s.census);
  accelerations<Effects>(s);
  gear_correct(grains.x, grains.vx, s.of_x, s.ax, s.dt);
  gear_correct(grains.y, grains.vy, s.of_y, s.ay, s.dt);
  if constexpr (Effects::rotation) gear_correct(grains.angle, grains.omega, s.of_angle, s.alpha, s.dt);
  s.wall_power = s.census.wall_power;
  add_wall_work(s, 0.5 * s.dt * (power_before + s.wall_power));
}

/// One step of the classical fourth-order scheme that leaves no trace in the contacts' memory.
void runge_kutta4(Integration& s, double time, ContactCensus& census) {
  const Grains start = s.grains;
  Grains end = s.grains;
  const double h = s.dt;
  const auto stage = [&](double at, double weight, double ahead) {
    accelerations_now(s, at, {}, census);
    const auto move = [&](std::vector<double>& x, std::vector<double>& v, const std::vector<double>& x0,
                          const std::vector<double>& v0, std::vector<double>& x1, std::vector<double>& v1,
                          const std::vector<double>& a) {
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (!x.empty()) x1[i] += weight * h * v[i], x[i] = x0[i] + ahead * h * v[i];
        v1[i] += weight * h * a[i], v[i] = v0[i] + ahead * h * a[i];
      }
    };
    Grains& g = s.grains;
    move(g.x, g.vx, start.x, start.vx, end.x, end.vx, s.ax);
    move(g.y, g.vy, start.y, start.vy, end.y, end.vy, s.ay);
    move(g.angle, g.omega, start.angle, start.omega, end.angle, end.omega, s.alpha);
  };
  stage(time, 1.0 / 6, 0.5), stage(time + 0.5 * h, 1.0 / 3, 0.5), stage(time + 0.5 * h, 1.0 / 3, 1);
  stage(time + h, 1.0 / 6, 1);
  s.grains = end;
}

/// h^n / n! times the derivatives at the first of four equally spaced accelerations, by the cubic through them.
void fit_derivatives(const std::array<std::vector<double>, 4>& a, double h, HigherDerivatives& higher) {
  const std::size_t n = a[0].size();
  for (std::vector<double>& q : higher) q.resize(n);
  const double h2 = h * h;
  for (std::size_t i = 0; i < n; ++i) {
    higher[0][i] = h2 / 2 * a[0][i];
    higher[1][i] = h2 / 6 * (-11 * a[0][i] + 18 * a[1][i] - 9 * a[2][i] + 2 * a[3][i]) / 6;
    higher[2][i] = h2 / 24 * (2 * a[0][i] - 5 * a[1][i] + 4 * a[2][i] - a[3][i]);
    higher[3][i] = h2 / 120 * (-a[0][i] + 3 * a[1][i] - 3 * a[2][i] + a[3][i]);
  }
}

void start_gear(Integration& s) {
  const Grains start = s.grains;
  ContactCensus aside;  // a look ahead: what it meets has not happened
  std::array<std::vector<double>, 4> ax, ay, alpha;
  for (std::size_t k = 0; k < 4; ++k) {
    const double time = s.time + static_cast<double>(k) * s.dt;
    accelerations_now(s, time, {}, aside);
    ax[k] = s.ax, ay[k] = s.ay, alpha[k] = s.alpha;
    if (k < 3) runge_kutta4(s, time, aside);
  }
  s.grains = start;
  fit_derivatives(ax, s.dt, s.of_x), fit_derivatives(ay, s.dt, s.of_y), fit_derivatives(alpha, s.dt, s.of_angle);
}

template <class Effects>
StepFunction scheme(Integrator integrator) {
  switch (integrator) {
    case Integrator::velocity_verlet:
      return velocity_verlet<Effects>;
    case Integrator::rk2_midpoint:
      return rk2_midpoint<Effects>;
    case Integrator::gear5:
      return gear5<Effects>;
  }
  return nullptr;
}

}  // namespace

StepFunction step_function(Integrator integrator, bool rotation, bool drag, bool unequal) {
  const auto with = [&]<bool r, bool d>() {
    return unequal ? scheme<BodyEffects<r, d, true>>(integrator) : scheme<BodyEffects<r, d, false>>(integrator);
  };
  if (rotation) return drag ? with.template operator()<true, true>() : with.template operator()<true, false>();
  return drag ? with.template operator()<false, true>() : with.template operator()<false, false>();
}

void start_integration(Integration& s) {
  if (s.scheme == Integrator::gear5) start_gear(s);
  accelerations_now(s, s.time, {}, s.census);
  s.wall_power = s.census.wall_power;
}

void add_to_integration(Integration& s) {
  accelerations_now(s, s.time, {}, s.census);
  s.wall_power = s.census.wall_power;
  if (s.scheme != Integrator::gear5) return;
  // Newcomers start with their acceleration; those who were there keep what they have.
  const auto extend = [&s](HigherDerivatives& higher, const std::vector<double>& a) {
    for (std::size_t i = higher[0].size(); i < a.size(); ++i) {
      higher[0].push_back(0.5 * s.dt * s.dt * a[i]);
      for (std::size_t n = 1; n < 4; ++n) higher[n].push_back(0);
    }
  };
  extend(s.of_x, s.ax), extend(s.of_y, s.ay), extend(s.of_angle, s.alpha);
}

void remove_from_integration(Integration& s, const std::vector<char>& removed) {
  accelerations_now(s, s.time, {}, s.census);
  s.wall_power = s.census.wall_power;
  if (s.scheme != Integrator::gear5) return;
  for (HigherDerivatives* higher : {&s.of_x, &s.of_y, &s.of_angle})
    for (std::vector<double>& q : *higher) {
      if (q.empty()) continue;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < removed.size(); ++i)
        if (!removed[i]) q[kept++] = q[i];
      q.resize(kept);
    }
}

int evaluations_per_step(Integrator integrator) {
  return integrator == Integrator::rk2_midpoint ? 2 : 1;
}

}  // namespace vibrosow
