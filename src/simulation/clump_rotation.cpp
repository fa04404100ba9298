#include "simulation/clump_rotation.hpp"

#include "grains/turning_clump.hpp"

namespace vibrosow {
namespace {

/// Clumps that are kept from turning have no inertia to divide by.
bool turns(const Grains& grains, std::size_t i) {
  return grains.inverse_inertia[i] > 0;
}

Vector3 torque_of(const Integration& s, std::size_t i) {
  const GrainVector& torque = s.field.torques_3d()[i];
  return {torque.x, torque.y, torque.z};
}

Vector3 kept_torque(const Integration& s, std::size_t i) {
  return {s.kept.alpha_x[i], s.kept.alpha_y[i], s.kept.alpha[i]};
}

void keep(Integration& s, std::size_t i, const Vector3& turning) {
  s.kept.alpha_x[i] = turning.x, s.kept.alpha_y[i] = turning.y, s.kept.alpha[i] = turning.z;
}

void keep_rates_for_gear(Integration& s, std::size_t i) {
  Vector3 acceleration;
  Orientation rate{0, 0, 0, 0};
  if (turns(s.grains, i)) {
    const TurningClump clump = turning_clump(s.grains, i);
    const Vector3 spin = spin_of(s.grains, i), half = 0.5 * spin;
    acceleration = clump.spin_of(torque_of(s, i) - cross(spin, clump.momentum_of(spin)));
    rate = Orientation{0, half.x, half.y, half.z} * s.grains.orientation(i);
  }
  keep(s, i, acceleration);
  const double rates[] = {rate.w, rate.x, rate.y, rate.z};
  for (std::size_t k = 0; k < 4; ++k) s.kept.quaternion_rate[k][i] = rates[k];
}

/// At the beginning of a step (rk2_midpoint).
Vector3 spin_at_start(const Integration& s, std::size_t i) {
  const std::size_t first = s.moving.along.size();
  return {s.speeds[first][i], s.speeds[first + 1][i], s.speeds[first + 2][i]};
}

/// From the grain number `from` on.
ClumpTurning turning_from(Integration& s, std::size_t from) {
  Grains& g = s.grains;
  return {{&g.q_w[from], &g.q_x[from], &g.q_y[from], &g.q_z[from]},
          {&g.omega_x[from], &g.omega_y[from], &g.omega[from]},
          &g.lot[from],
          &g.inverse_inertia[from],
          {s.moments[0].data(), s.moments[1].data(), s.moments[2].data()}};
}

}  // namespace

void predict_clump_rotation(Integration& s, std::size_t from, std::size_t to) {
  s.execution.clump_loops().predict(to - from, s.dt, turning_from(s, from),
                                    {&s.kept.alpha_x[from], &s.kept.alpha_y[from], &s.kept.alpha[from]});
}

void correct_clump_rotation(Integration& s, std::size_t from, std::size_t to) {
  s.execution.clump_loops().correct(to - from, s.dt, turning_from(s, from), &s.field.torques_3d()[from],
                                    {&s.kept.alpha_x[from], &s.kept.alpha_y[from], &s.kept.alpha[from]});
}

void keep_clump_rates(Integration& s, std::size_t from, std::size_t to) {
  const bool gear = s.model.scene.numerics.integrator == Integrator::gear5;
  for (std::size_t i = from; i < to; ++i) gear ? keep_rates_for_gear(s, i) : keep(s, i, torque_of(s, i));
}

void advance_clump_rotation(Integration& s, double dt, std::size_t from, std::size_t to) {
  Grains& grains = s.grains;
  for (std::size_t i = from; i < to; ++i) {
    if (!turns(grains, i)) continue;
    const Vector3 present_spin = spin_of(grains, i);
    grains.set_orientation(i, s.orientation[i]);
    TurningClump clump = turning_clump(grains, i);
    const Vector3 momentum = clump.momentum_of(spin_at_start(s, i));
    clump.turn(present_spin, dt);
    grains.set_orientation(i, clump.orientation());
    set_spin(grains, i, clump.spin_of(momentum + dt * kept_torque(s, i)));
  }
}

void bring_to_unit_length(Grains& grains, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) grains.set_orientation(i, of_unit_length(grains.orientation(i)));
}

}  // namespace vibrosow
