#include "simulation/integrator.hpp"

#include <cmath>

#include "simulation/clump_rotation.hpp"

namespace vibrosow {
namespace {

PerGrain per_mass(const Grains& grains, std::size_t from) {
  return {grains.polydisperse ? grains.inverse_mass.data() + from : nullptr, grains.kinds.front().inverse_mass};
}
PerGrain per_inertia(const Grains& grains, std::size_t from) {
  return {grains.polydisperse ? grains.inverse_inertia.data() + from : nullptr, grains.kinds.front().inverse_inertia};
}

/// The forces of the last evaluation on the grains from number `a`.
Drive drive_of(const Integration& s, std::size_t a) {
  return {&s.field.forces()[a], per_mass(s.grains, a), per_inertia(s.grains, a),
          s.model.gravity.x(),  s.model.gravity.y(),   s.drag};
}
Rates rates_of(Integration& s, std::size_t a) {
  const bool turns = s.grains.rotation;
  return {&s.grains.vx[a], &s.grains.vy[a], turns ? &s.grains.omega[a] : nullptr,
          &s.kept.ax[a],   &s.kept.ay[a],   turns ? &s.kept.alpha[a] : nullptr};
}

SpaceDrive space_drive_of(const Integration& s, std::size_t a) {
  const auto& torques = s.field.torques_in_space();
  return {&s.field.forces_in_space()[a],
          torques.empty() ? nullptr : &torques[a],
          per_mass(s.grains, a),
          per_inertia(s.grains, a),
          s.model.gravity.x(),
          s.model.gravity.y(),
          0,
          s.drag};
}
SpaceRates space_rates_of(Integration& s, std::size_t a) {
  Grains& g = s.grains;
  IntegratorState& k = s.kept;
  SpaceRates rates{{&g.vx[a], &g.vy[a], &g.vz[a]}, {}, {&k.ax[a], &k.ay[a], &k.az[a]}, {}};
  if (!g.rotation || g.oriented) return rates;  // clumps turn in their own way
  rates.omega[0] = &g.omega_x[a], rates.omega[1] = &g.omega_y[a], rates.omega[2] = &g.omega[a];
  rates.alpha[0] = &k.alpha_x[a], rates.alpha[1] = &k.alpha_y[a], rates.alpha[2] = &k.alpha[a];
  return rates;
}

/// Of those that are driven: without friction nothing turns a ball, and there are no torques.
SpaceRates driven_in_space(Integration& s, std::size_t a) {
  SpaceRates rates = space_rates_of(s, a);
  if (s.field.torques_in_space().empty()) rates.omega[0] = nullptr;
  return rates;
}

void accelerations_in_space(Integration& s) {
  const Grains& grains = s.grains;
  const std::size_t n = grains.size(), turning = grains.omega.size();
  for (std::vector<double>* a : {&s.kept.ax, &s.kept.ay, &s.kept.az}) a->resize(n);
  for (std::vector<double>* a : {&s.kept.alpha_x, &s.kept.alpha_y, &s.kept.alpha}) a->resize(turning);
  if (grains.oriented && s.model.scene.numerics.integrator == Integrator::gear5)
    for (std::vector<double>& rate : s.kept.quaternion_rate) rate.resize(turning);
  s.execution.share(n, [&](std::size_t a, std::size_t b) {
    s.execution.space_loops().accelerate(b - a, space_drive_of(s, a), driven_in_space(s, a));
    if (turn_as_clumps(grains)) keep_clump_rates(s, a, b);
  });
}

/// a = F / m + g - (mu / m) v, alpha = T / J, of clumps in space T, into the arrays of `s`.
void accelerations(Integration& s) {
  const Grains& grains = s.grains;
  if (grains.in_space) return accelerations_in_space(s);
  s.kept.ax.resize(grains.size()), s.kept.ay.resize(grains.size()), s.kept.alpha.resize(grains.omega.size());
  s.execution.share(grains.size(), [&](std::size_t a, std::size_t b) {
    s.execution.loops().accelerate(b - a, drive_of(s, a), rates_of(s, a));
  });
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

void accelerations_now(Integration& s, double time, const HistoryAdvance& advance, ContactStatistics& statistics) {
  s.field.evaluate(time, advance, statistics);
  accelerations(s);
}

void add_wall_work(Integration& s, double work) {
  s.kept.wall_work += work;
  s.kept.gross_wall_work += std::abs(work);
}

double next_time(const Integration& s) {
  return static_cast<double>(s.state.step + 1) * s.dt;
}

/// At the end of a step, while the velocities are at hand.
void watch_speed(Integration& s, std::size_t a, std::size_t b) {
  const Grains& g = s.grains;
  if (g.in_space) {
    if (s.execution.space_loops().any_faster(b - a, &g.vx[a], &g.vy[a], &g.vz[a], s.fastest)) s.too_fast = true;
    return;
  }
  if (s.execution.loops().any_faster(b - a, &s.grains.vx[a], &s.grains.vy[a], s.fastest)) s.too_fast = true;
}

/// Angles are kept of clumps in the plane alone.
double* angle_or_null(Grains& grains, std::size_t from) {
  return grains.angle.empty() ? nullptr : &grains.angle[from];
}

/// Places, predicted velocities and spins at the end of a step.
void predict(Integration& s) {
  Grains& grains = s.grains;
  const GrainLoops& loops = s.execution.loops();
  s.execution.share(grains.size(), [&](std::size_t a, std::size_t b) {
    loops.predict(b - a, s.dt, &grains.x[a], &grains.vx[a], &s.kept.ax[a]);
    loops.predict(b - a, s.dt, &grains.y[a], &grains.vy[a], &s.kept.ay[a]);
    if (grains.in_space) loops.predict(b - a, s.dt, &grains.z[a], &grains.vz[a], &s.kept.az[a]);
    if (turn_as_clumps(grains))
      predict_clump_rotation(s, a, b);
    else if (grains.rotation)
      loops.predict(b - a, s.dt, angle_or_null(grains, a), &grains.omega[a], &s.kept.alpha[a]);
  });
}

/// The same of balls in space, with the rows that kernels read.
void predict_balls(Integration& s) {
  Grains& g = s.grains;
  const BallRows rows = s.field.rows_to_set();
  s.execution.share(g.size(), [&](std::size_t a, std::size_t b) {
    s.execution.space_loops().predict(b - a, s.dt, {&g.x[a], &g.y[a], &g.z[a]}, space_rates_of(s, a),
                                      {rows.places + a, rows.motions + a});
  });
}

void velocity_verlet(Integration& s) {
  Grains& grains = s.grains;
  grains.in_space && !s.model.effects.clumps ? predict_balls(s) : predict(s);
  s.execution.profile().lap(Phase::integration);
  const double power_before = s.kept.wall_power;
  s.field.evaluate(next_time(s), {.trial = s.dt, .commit = s.dt, .present = 0.5}, s.state.statistics);

  s.execution.share(grains.size(), [&](std::size_t a, std::size_t b) {
    if (grains.in_space)
      s.execution.space_loops().correct(b - a, s.dt, space_drive_of(s, a), driven_in_space(s, a));
    else
      s.execution.loops().correct(b - a, s.dt, drive_of(s, a), rates_of(s, a));
    if (turn_as_clumps(grains)) correct_clump_rotation(s, a, b);
    watch_speed(s, a, b);
  });
  s.kept.wall_power = s.state.statistics.wall_power;
  add_wall_work(s, 0.5 * s.dt * (power_before + s.kept.wall_power));
}

void note_orientations(Integration& s) {
  s.orientation.clear();
  for (std::size_t i = 0; i < s.grains.size(); ++i) s.orientation.push_back(s.grains.orientation(i));
}

void rk2_midpoint(Integration& s) {
  Grains& grains = s.grains;
  s.field.evaluate(s.state.time, {}, s.state.statistics);
  accelerations(s);
  s.x = grains.x, s.y = grains.y, s.vx = grains.vx, s.vy = grains.vy, s.omega = grains.omega, s.angle = grains.angle;
  s.z = grains.z, s.vz = grains.vz, s.omega_x = grains.omega_x, s.omega_y = grains.omega_y;  // in the plane all empty
  const bool as_clumps = turn_as_clumps(grains);
  if (as_clumps) note_orientations(s);
  const double half = 0.5 * s.dt;
  add_scaled(grains.x, s.vx, half), add_scaled(grains.y, s.vy, half);
  add_scaled(grains.vx, s.kept.ax, half), add_scaled(grains.vy, s.kept.ay, half);
  add_scaled(grains.z, s.vz, half), add_scaled(grains.vz, s.kept.az, half);
  if (as_clumps) {
    advance_clump_rotation(s, half, 0, grains.size());
  } else if (grains.rotation) {
    add_scaled(grains.angle, s.omega, half);
    add_scaled(grains.omega, s.kept.alpha, half);
    add_scaled(grains.omega_x, s.kept.alpha_x, half), add_scaled(grains.omega_y, s.kept.alpha_y, half);
  }

  s.field.evaluate(s.state.time + half, {.trial = half, .commit = s.dt, .present = 1}, s.state.statistics);
  accelerations(s);
  set_sum(grains.x, s.x, grains.vx, s.dt), set_sum(grains.y, s.y, grains.vy, s.dt);
  set_sum(grains.vx, s.vx, s.kept.ax, s.dt), set_sum(grains.vy, s.vy, s.kept.ay, s.dt);
  set_sum(grains.z, s.z, grains.vz, s.dt), set_sum(grains.vz, s.vz, s.kept.az, s.dt);
  if (as_clumps) {
    advance_clump_rotation(s, s.dt, 0, grains.size());
  } else if (grains.rotation) {
    set_sum(grains.angle, s.angle, grains.omega, s.dt);
    set_sum(grains.omega, s.omega, s.kept.alpha, s.dt);
    set_sum(grains.omega_x, s.omega_x, s.kept.alpha_x, s.dt), set_sum(grains.omega_y, s.omega_y, s.kept.alpha_y, s.dt);
  }
  s.execution.share(grains.size(), [&](std::size_t a, std::size_t b) { watch_speed(s, a, b); });
  add_wall_work(s, s.dt * s.state.statistics.wall_power);
}

void gear_predict(Integration& s, double* x, double* v, HigherDerivatives& q, std::size_t a, std::size_t b) {
  s.execution.loops().gear_predict(b - a, s.dt, x, v, &q[0][a], &q[1][a], &q[2][a], &q[3][a]);
}

void gear_correct(Integration& s, double* x, double* v, HigherDerivatives& q, const std::vector<double>& acceleration,
                  std::size_t a, std::size_t b) {
  s.execution.loops().gear_correct(b - a, s.dt, &acceleration[a], x, v, &q[0][a], &q[1][a], &q[2][a], &q[3][a]);
}

void gear5(Integration& s) {
  Grains& g = s.grains;
  s.execution.share(g.size(), [&](std::size_t a, std::size_t b) {
    gear_predict(s, &g.x[a], &g.vx[a], s.kept.of_x, a, b);
    gear_predict(s, &g.y[a], &g.vy[a], s.kept.of_y, a, b);
    if (g.rotation) gear_predict(s, angle_or_null(g, a), &g.omega[a], s.kept.of_angle, a, b);
    if (!g.in_space) return;
    gear_predict(s, &g.z[a], &g.vz[a], s.kept.of_z, a, b);
    if (!g.rotation) return;
    gear_predict(s, nullptr, &g.omega_x[a], s.kept.of_angle_x, a, b);
    gear_predict(s, nullptr, &g.omega_y[a], s.kept.of_angle_y, a, b);
    if (!g.oriented) return;
    for (std::size_t k = 0; k < 4; ++k)
      gear_predict(s, nullptr, g.quaternions()[k]->data() + a, s.kept.of_quaternion[k], a, b);
  });
  s.execution.profile().lap(Phase::integration);
  const double power_before = s.kept.wall_power;
  s.field.evaluate(next_time(s), {.trial = s.dt, .commit = s.dt, .present = 0.5}, s.state.statistics);
  accelerations(s);
  s.execution.share(g.size(), [&](std::size_t a, std::size_t b) {
    gear_correct(s, &g.x[a], &g.vx[a], s.kept.of_x, s.kept.ax, a, b);
    gear_correct(s, &g.y[a], &g.vy[a], s.kept.of_y, s.kept.ay, a, b);
    if (g.rotation) gear_correct(s, angle_or_null(g, a), &g.omega[a], s.kept.of_angle, s.kept.alpha, a, b);
    if (g.in_space) gear_correct(s, &g.z[a], &g.vz[a], s.kept.of_z, s.kept.az, a, b);
    if (g.in_space && g.rotation) {
      gear_correct(s, nullptr, &g.omega_x[a], s.kept.of_angle_x, s.kept.alpha_x, a, b);
      gear_correct(s, nullptr, &g.omega_y[a], s.kept.of_angle_y, s.kept.alpha_y, a, b);
    }
    if (turn_as_clumps(g)) {
      for (std::size_t k = 0; k < 4; ++k)
        gear_correct(s, nullptr, g.quaternions()[k]->data() + a, s.kept.of_quaternion[k], s.kept.quaternion_rate[k], a,
                     b);
      bring_to_unit_length(g, a, b);
    }
    watch_speed(s, a, b);
  });
  s.kept.wall_power = s.state.statistics.wall_power;
  add_wall_work(s, 0.5 * s.dt * (power_before + s.kept.wall_power));
}

/// One step of the classical fourth-order scheme that leaves no trace in the contacts' memory.
void runge_kutta4(Integration& s, double time, ContactStatistics& statistics) {
  Grains start = s.grains, end = s.grains;
  const double h = s.dt;
  const auto stage = [&](double at, double weight, double ahead) {
    accelerations_now(s, at, {}, statistics);
    const auto move = [&](std::vector<double>& x, std::vector<double>& v, const std::vector<double>& x0,
                          const std::vector<double>& v0, std::vector<double>& x1, std::vector<double>& v1,
                          const std::vector<double>& a) {
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (!x.empty()) x1[i] += weight * h * v[i], x[i] = x0[i] + ahead * h * v[i];
        v1[i] += weight * h * a[i], v[i] = v0[i] + ahead * h * a[i];
      }
    };
    Grains& g = s.grains;
    move(g.x, g.vx, start.x, start.vx, end.x, end.vx, s.kept.ax);
    move(g.y, g.vy, start.y, start.vy, end.y, end.vy, s.kept.ay);
    move(g.angle, g.omega, start.angle, start.omega, end.angle, end.omega, s.kept.alpha);
    move(g.z, g.vz, start.z, start.vz, end.z, end.vz, s.kept.az);
    std::vector<double> none;
    move(none, g.omega_x, none, start.omega_x, none, end.omega_x, s.kept.alpha_x);
    move(none, g.omega_y, none, start.omega_y, none, end.omega_y, s.kept.alpha_y);
    for (std::size_t k = 0; turn_as_clumps(g) && k < 4; ++k)
      move(none, *g.quaternions()[k], none, *start.quaternions()[k], none, *end.quaternions()[k],
           s.kept.quaternion_rate[k]);
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
  ContactStatistics aside;  // a look ahead: what it meets has not happened
  std::array<std::vector<double>, 4> ax, ay, alpha, az, alpha_x, alpha_y;
  std::array<std::array<std::vector<double>, 4>, 4> quaternion_rate;  // of each component its four
  for (std::size_t k = 0; k < 4; ++k) {
    const double time = s.state.time + static_cast<double>(k) * s.dt;
    accelerations_now(s, time, {}, aside);
    ax[k] = s.kept.ax, ay[k] = s.kept.ay, alpha[k] = s.kept.alpha;
    az[k] = s.kept.az, alpha_x[k] = s.kept.alpha_x, alpha_y[k] = s.kept.alpha_y;
    for (std::size_t q = 0; q < 4; ++q) quaternion_rate[q][k] = s.kept.quaternion_rate[q];
    if (k < 3) runge_kutta4(s, time, aside);
  }
  s.grains = start;
  fit_derivatives(ax, s.dt, s.kept.of_x), fit_derivatives(ay, s.dt, s.kept.of_y),
      fit_derivatives(alpha, s.dt, s.kept.of_angle);
  fit_derivatives(az, s.dt, s.kept.of_z);
  fit_derivatives(alpha_x, s.dt, s.kept.of_angle_x), fit_derivatives(alpha_y, s.dt, s.kept.of_angle_y);
  for (std::size_t q = 0; q < 4; ++q) fit_derivatives(quaternion_rate[q], s.dt, s.kept.of_quaternion[q]);
}

}  // namespace

StepFunction step_function(Integrator integrator) {
  switch (integrator) {
    case Integrator::velocity_verlet:
      return velocity_verlet;
    case Integrator::rk2_midpoint:
      return rk2_midpoint;
    case Integrator::gear5:
      return gear5;
  }
  return nullptr;
}

void start_integration(Integration& s) {
  if (s.model.scene.numerics.integrator == Integrator::gear5) start_gear(s);
  accelerations_now(s, s.state.time, {}, s.state.statistics);
  s.kept.wall_power = s.state.statistics.wall_power;
}

void add_to_integration(Integration& s) {
  accelerations_now(s, s.state.time, {}, s.state.statistics);
  s.kept.wall_power = s.state.statistics.wall_power;
  if (s.model.scene.numerics.integrator != Integrator::gear5) return;
  // Newcomers start with their acceleration; those who were there keep what they have.
  const auto extend = [&s](HigherDerivatives& higher, const std::vector<double>& a) {
    for (std::size_t i = higher[0].size(); i < a.size(); ++i) {
      higher[0].push_back(0.5 * s.dt * s.dt * a[i]);
      for (std::size_t n = 1; n < 4; ++n) higher[n].push_back(0);
    }
  };
  extend(s.kept.of_x, s.kept.ax), extend(s.kept.of_y, s.kept.ay), extend(s.kept.of_angle, s.kept.alpha);
  extend(s.kept.of_z, s.kept.az), extend(s.kept.of_angle_x, s.kept.alpha_x), extend(s.kept.of_angle_y, s.kept.alpha_y);
  for (std::size_t q = 0; q < 4; ++q) extend(s.kept.of_quaternion[q], s.kept.quaternion_rate[q]);
}

void remove_from_integration(Integration& s, const std::vector<char>& removed) {
  accelerations_now(s, s.state.time, {}, s.state.statistics);
  s.kept.wall_power = s.state.statistics.wall_power;
  if (s.model.scene.numerics.integrator != Integrator::gear5) return;
  const auto keep = [&removed](HigherDerivatives& higher) {
    for (std::vector<double>& q : higher) {
      if (q.empty()) continue;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < removed.size(); ++i)
        if (!removed[i]) q[kept++] = q[i];
      q.resize(kept);
    }
  };
  for (HigherDerivatives* higher :
       {&s.kept.of_x, &s.kept.of_y, &s.kept.of_angle, &s.kept.of_z, &s.kept.of_angle_x, &s.kept.of_angle_y})
    keep(*higher);
  for (HigherDerivatives& higher : s.kept.of_quaternion) keep(higher);
}

int evaluations_per_step(Integrator integrator) {
  return integrator == Integrator::rk2_midpoint ? 2 : 1;
}

}  // namespace vibrosow
