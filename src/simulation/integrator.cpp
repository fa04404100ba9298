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

Drive3d drive_of_3d(const Integration& s, std::size_t a) {
  const auto& torques = s.field.torques_3d();
  return {&s.field.forces_3d()[a],
          torques.empty() ? nullptr : &torques[a],
          per_mass(s.grains, a),
          per_inertia(s.grains, a),
          s.model.gravity.x(),
          s.model.gravity.y(),
          0,
          s.drag};
}
Rates3d rates_of_3d(Integration& s, std::size_t a) {
  Grains& g = s.grains;
  IntegratorState& k = s.kept;
  Rates3d rates{{&g.vx[a], &g.vy[a], &g.vz[a]}, {}, {&k.ax[a], &k.ay[a], &k.az[a]}, {}};
  if (!g.rotation || g.oriented) return rates;  // clumps turn in their own way
  rates.omega[0] = &g.omega_x[a], rates.omega[1] = &g.omega_y[a], rates.omega[2] = &g.omega[a];
  rates.alpha[0] = &k.alpha_x[a], rates.alpha[1] = &k.alpha_y[a], rates.alpha[2] = &k.alpha[a];
  return rates;
}

/// Of those that are driven: without friction nothing turns a ball, and there are no torques.
Rates3d driven_3d(Integration& s, std::size_t a) {
  Rates3d rates = rates_of_3d(s, a);
  if (s.field.torques_3d().empty()) rates.omega[0] = nullptr;
  return rates;
}

void accelerations_3d(Integration& s) {
  const Grains& grains = s.grains;
  const std::size_t n = grains.size(), turning = grains.omega.size();
  for (std::vector<double>* a : {&s.kept.ax, &s.kept.ay, &s.kept.az}) a->resize(n);
  for (std::vector<double>* a : {&s.kept.alpha_x, &s.kept.alpha_y, &s.kept.alpha}) a->resize(turning);
  if (grains.oriented && s.model.scene.numerics.integrator == Integrator::gear5)
    for (std::vector<double>& rate : s.kept.quaternion_rate) rate.resize(turning);
  s.execution.share(n, [&](std::size_t a, std::size_t b) {
    s.execution.loops_3d().accelerate(b - a, drive_of_3d(s, a), driven_3d(s, a));
    if (turn_as_clumps(grains)) keep_clump_rates(s, a, b);
  });
}

/// a = F / m + g - (mu / m) v, alpha = T / J, of clumps in 3D T, into the arrays of `s`.
void accelerations(Integration& s) {
  const Grains& grains = s.grains;
  if (grains.is_3d) return accelerations_3d(s);
  s.kept.ax.resize(grains.size()), s.kept.ay.resize(grains.size()), s.kept.alpha.resize(grains.omega.size());
  s.execution.share(grains.size(), [&](std::size_t a, std::size_t b) {
    s.execution.loops().accelerate(b - a, drive_of(s, a), rates_of(s, a));
  });
}

/// Where the values of a coordinate begin from grain number `a` on; null where there are none.
double* from(std::vector<double>* values, std::size_t a) {
  return values == nullptr || values->empty() ? nullptr : values->data() + a;
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

void accelerations_now(Integration& s, double time, const ContactStep& step, ContactStatistics& statistics) {
  s.field.evaluate(time, step, statistics);
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
  if (g.is_3d) {
    if (s.execution.loops_3d().any_faster(b - a, &g.vx[a], &g.vy[a], &g.vz[a], s.fastest)) s.too_fast = true;
    return;
  }
  if (s.execution.loops().any_faster(b - a, &s.grains.vx[a], &s.grains.vy[a], s.fastest)) s.too_fast = true;
}

/// Velocities and spins in the middle of a step, places at its end.
void predict(Integration& s) {
  const GrainLoops& loops = s.execution.loops();
  const bool as_clumps = turn_as_clumps(s.grains);
  s.execution.share(s.grains.size(), [&](std::size_t a, std::size_t b) {
    const auto ahead = [&](const std::vector<Coordinate>& coordinates) {
      for (const Coordinate& c : coordinates)
        loops.predict(b - a, s.dt, from(c.place, a), from(c.speed, a), from(c.rate, a));
    };
    ahead(s.moving.along);
    as_clumps ? predict_clump_rotation(s, a, b) : ahead(s.moving.about);
  });
}

/// The same of balls in 3D, with the rows that kernels read.
void predict_balls(Integration& s) {
  Grains& g = s.grains;
  const BallRows rows = s.field.rows_to_set();
  s.execution.share(g.size(), [&](std::size_t a, std::size_t b) {
    s.execution.loops_3d().predict(b - a, s.dt, {&g.x[a], &g.y[a], &g.z[a]}, rates_of_3d(s, a),
                                   {rows.places + a, rows.motions + a});
  });
}

void velocity_verlet(Integration& s) {
  Grains& grains = s.grains;
  grains.is_3d && !s.model.effects.clumps ? predict_balls(s) : predict(s);
  s.execution.profile().lap(Phase::integration);
  const double power_before = s.kept.wall_power;
  const double lag = 0.5 * s.dt;
  const ContactStep step{.trial = s.dt,
                         .commit = s.dt,
                         .lag = lag,
                         .fall_x = lag * s.model.gravity.x(),
                         .fall_y = lag * s.model.gravity.y(),
                         .brake = lag * s.drag};
  s.field.evaluate(next_time(s), step, s.state.statistics);

  s.execution.share(grains.size(), [&](std::size_t a, std::size_t b) {
    if (grains.is_3d)
      s.execution.loops_3d().correct(b - a, s.dt, drive_of_3d(s, a), driven_3d(s, a));
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
  s.field.evaluate(s.state.time, {}, s.state.statistics);
  accelerations(s);
  const std::vector<Coordinate>& all = s.moving.axes;
  const bool as_clumps = turn_as_clumps(s.grains);
  const std::size_t driven = as_clumps ? s.moving.along.size() : all.size();
  s.places.resize(all.size()), s.speeds.resize(all.size());
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].place) s.places[c] = *all[c].place;
    s.speeds[c] = *all[c].speed;
  }
  if (as_clumps) note_orientations(s);
  const double half = 0.5 * s.dt;
  for (std::size_t c = 0; c < driven; ++c) {
    if (all[c].place) add_scaled(*all[c].place, s.speeds[c], half);
    add_scaled(*all[c].speed, *all[c].rate, half);
  }
  if (as_clumps) advance_clump_rotation(s, half, 0, s.grains.size());

  s.field.evaluate(s.state.time + half, {.trial = half, .commit = s.dt}, s.state.statistics);
  accelerations(s);
  for (std::size_t c = 0; c < driven; ++c) {
    if (all[c].place) set_sum(*all[c].place, s.places[c], *all[c].speed, s.dt);
    set_sum(*all[c].speed, s.speeds[c], *all[c].rate, s.dt);
  }
  if (as_clumps) advance_clump_rotation(s, s.dt, 0, s.grains.size());
  s.execution.share(s.grains.size(), [&](std::size_t a, std::size_t b) { watch_speed(s, a, b); });
  add_wall_work(s, s.dt * s.state.statistics.wall_power);
}

/// Calls `visit` with each coordinate that Gear's scheme moves.
template <class Visit>
void for_each_of_gear(Integration& s, Visit visit) {
  for (const auto* coordinates : {&s.moving.along, &s.moving.about, &s.moving.quaternions})
    for (const Coordinate& c : *coordinates) visit(c);
}

void gear5(Integration& s) {
  const GrainLoops& loops = s.execution.loops();
  s.execution.share(s.grains.size(), [&](std::size_t a, std::size_t b) {
    for_each_of_gear(s, [&](const Coordinate& c) {
      HigherDerivatives& q = *c.higher;
      loops.gear_predict(b - a, s.dt, from(c.place, a), from(c.speed, a), &q[0][a], &q[1][a], &q[2][a], &q[3][a]);
    });
  });
  s.execution.profile().lap(Phase::integration);
  const double power_before = s.kept.wall_power;
  s.field.evaluate(next_time(s), {.trial = 0.5 * s.dt, .commit = s.dt}, s.state.statistics);
  accelerations(s);
  s.execution.share(s.grains.size(), [&](std::size_t a, std::size_t b) {
    for_each_of_gear(s, [&](const Coordinate& c) {
      HigherDerivatives& q = *c.higher;
      loops.gear_correct(b - a, s.dt, from(c.rate, a), from(c.place, a), from(c.speed, a), &q[0][a], &q[1][a], &q[2][a],
                         &q[3][a]);
    });
    if (turn_as_clumps(s.grains)) bring_to_unit_length(s.grains, a, b);
    watch_speed(s, a, b);
  });
  s.kept.wall_power = s.state.statistics.wall_power;
  add_wall_work(s, 0.5 * s.dt * (power_before + s.kept.wall_power));
}

/// One step of the classical fourth-order scheme that leaves no trace in the contacts' memory.
void runge_kutta4(Integration& s, double time, ContactStatistics& statistics) {
  Grains start = s.grains, end = s.grains;
  const double h = s.dt;
  Moving began(start, s.kept), ended(end, s.kept);
  const auto stage = [&](double at, double weight, double ahead) {
    accelerations_now(s, at, {}, statistics);
    const auto move = [&](const Coordinate& now, const Coordinate& from_start, const Coordinate& to_end) {
      const bool has_place = now.place && !now.place->empty();
      for (std::size_t i = 0; i < now.speed->size(); ++i) {
        double& v = (*now.speed)[i];
        const double rate = (*now.rate)[i], v0 = (*from_start.speed)[i];
        if (has_place) {
          (*to_end.place)[i] += weight * h * v;
          (*now.place)[i] = (*from_start.place)[i] + ahead * h * v;
        }
        (*to_end.speed)[i] += weight * h * rate;
        v = v0 + ahead * h * rate;
      }
    };
    for (const auto coordinates : {&Moving::along, &Moving::about, &Moving::quaternions})
      for (std::size_t c = 0; c < (s.moving.*coordinates).size(); ++c)
        move((s.moving.*coordinates)[c], (began.*coordinates)[c], (ended.*coordinates)[c]);
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
  ContactStatistics aside;                                // a look ahead: what it meets has not happened
  std::vector<std::array<std::vector<double>, 4>> rates;  // of each coordinate
  for (std::size_t k = 0; k < 4; ++k) {
    const double time = s.state.time + static_cast<double>(k) * s.dt;
    accelerations_now(s, time, {}, aside);
    std::size_t of = 0;
    for_each_of_gear(s, [&](const Coordinate& c) {
      if (k == 0) rates.emplace_back();
      rates[of++][k] = *c.rate;
    });
    if (k < 3) runge_kutta4(s, time, aside);
  }
  s.grains = start;
  std::size_t of = 0;
  for_each_of_gear(s, [&](const Coordinate& c) { fit_derivatives(rates[of++], s.dt, *c.higher); });
}

}  // namespace

Moving::Moving(Grains& g, IntegratorState& k) {
  along = {{&g.x, &g.vx, &k.ax, &k.of_x}, {&g.y, &g.vy, &k.ay, &k.of_y}};
  if (g.is_3d) along.push_back({&g.z, &g.vz, &k.az, &k.of_z});
  if (g.rotation && g.is_3d)
    about = {{nullptr, &g.omega_x, &k.alpha_x, &k.of_angle_x},
             {nullptr, &g.omega_y, &k.alpha_y, &k.of_angle_y},
             {nullptr, &g.omega, &k.alpha, &k.of_angle}};
  else if (g.rotation)
    about = {{&g.angle, &g.omega, &k.alpha, &k.of_angle}};
  axes = along;
  axes.insert(axes.end(), about.begin(), about.end());
  if (turn_as_clumps(g))
    for (std::size_t q = 0; q < 4; ++q)
      quaternions.push_back({nullptr, g.quaternions()[q], &k.quaternion_rate[q], &k.of_quaternion[q]});
}

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
  for_each_of_gear(s, [&s](const Coordinate& c) {
    const std::vector<double>& a = *c.rate;
    HigherDerivatives& higher = *c.higher;
    for (std::size_t i = higher[0].size(); i < a.size(); ++i) {
      higher[0].push_back(0.5 * s.dt * s.dt * a[i]);
      for (std::size_t n = 1; n < 4; ++n) higher[n].push_back(0);
    }
  });
}

void remove_from_integration(Integration& s, const std::vector<char>& removed) {
  accelerations_now(s, s.state.time, {}, s.state.statistics);
  s.kept.wall_power = s.state.statistics.wall_power;
  if (s.model.scene.numerics.integrator != Integrator::gear5) return;
  for_each_of_gear(s, [&removed](const Coordinate& c) {
    for (std::vector<double>& q : *c.higher) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < removed.size(); ++i)
        if (!removed[i]) q[kept++] = q[i];
      q.resize(kept);
    }
  });
}

int evaluations_per_step(Integrator integrator) {
  return integrator == Integrator::rk2_midpoint ? 2 : 1;
}

}  // namespace vibrosow
