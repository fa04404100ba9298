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
  if constexpr (Effects::rotation) add_scaled(grains.omega, s.alpha, s.dt);
  const double power_before = s.wall_power;
  s.field.evaluate(grains, next_time(s), s.census);

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
  s.field.evaluate(grains, s.time, s.census);
  accelerations<Effects>(s);
  s.x = grains.x, s.y = grains.y, s.vx = grains.vx, s.vy = grains.vy, s.omega = grains.omega;
  const double half = 0.5 * s.dt;
  add_scaled(grains.x, s.vx, half), add_scaled(grains.y, s.vy, half);
  add_scaled(grains.vx, s.ax, half), add_scaled(grains.vy, s.ay, half);
  if constexpr (Effects::rotation) add_scaled(grains.omega, s.alpha, half);

  s.field.evaluate(grains, s.time + half, s.census);
  accelerations<Effects>(s);
  set_sum(grains.x, s.x, grains.vx, s.dt), set_sum(grains.y, s.y, grains.vy, s.dt);
  set_sum(grains.vx, s.vx, s.ax, s.dt), set_sum(grains.vy, s.vy, s.ay, s.dt);
  if constexpr (Effects::rotation) set_sum(grains.omega, s.omega, s.alpha, s.dt);
  add_wall_work(s, s.dt * s.census.wall_power);
}

template <class Effects>
StepFunction scheme(Integrator integrator) {
  return integrator == Integrator::velocity_verlet ? velocity_verlet<Effects> : rk2_midpoint<Effects>;
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
  const Grains& grains = s.grains;
  s.ax.resize(grains.size()), s.ay.resize(grains.size()), s.alpha.resize(grains.omega.size());
  s.field.evaluate(grains, s.time, s.census);
  s.wall_power = s.census.wall_power;
  if (grains.rotation)
    grains.unequal ? accelerations<BodyEffects<true, true, true>>(s) : accelerations<BodyEffects<true, true, false>>(s);
  else
    grains.unequal ? accelerations<BodyEffects<false, true, true>>(s)
                   : accelerations<BodyEffects<false, true, false>>(s);
}

int evaluations_per_step(Integrator integrator) {
  return integrator == Integrator::velocity_verlet ? 1 : 2;
}

}  // namespace vibrosow
