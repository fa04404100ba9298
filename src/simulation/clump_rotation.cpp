#include "simulation/clump_rotation.hpp"

#include "grains/turning_clump.hpp"
#include "scene/cross_product.hpp"

namespace vibrosow {
namespace {

/// Clumps that are kept from turning have no inertia to divide by.
bool turns(const Grains& grains, std::size_t i) {
  return grains.inverse_inertia[i] > 0;
}

Eigen::Vector3d torque_of(const Integration& s, std::size_t i) {
  const GrainVector& torque = s.field.torques_in_space()[i];
  return {torque.x, torque.y, torque.z};
}

Eigen::Vector3d kept_torque(const Integration& s, std::size_t i) {
  return {s.kept.alpha_x[i], s.kept.alpha_y[i], s.kept.alpha[i]};
}

void keep(Integration& s, std::size_t i, const Eigen::Vector3d& turning) {
  s.kept.alpha_x[i] = turning.x(), s.kept.alpha_y[i] = turning.y(), s.kept.alpha[i] = turning.z();
}

void keep_rates_for_gear(Integration& s, std::size_t i) {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  Orientation rate{0, 0, 0, 0};
  if (turns(s.grains, i)) {
    const TurningClump clump(s.grains, i);
    const Eigen::Vector3d spin = spin_of(s.grains, i), half = 0.5 * spin;
    acceleration = clump.spin_of(torque_of(s, i) - cross(spin, clump.momentum_of(spin)));
    rate = Orientation{0, half.x(), half.y(), half.z()} * s.grains.orientation(i);
  }
  keep(s, i, acceleration);
  const double rates[] = {rate.w, rate.x, rate.y, rate.z};
  for (std::size_t k = 0; k < 4; ++k) s.kept.quaternion_rate[k][i] = rates[k];
}

}  // namespace

void predict_clump_rotation(Integration& s, std::size_t from, std::size_t to) {
  Grains& grains = s.grains;
  for (std::size_t i = from; i < to; ++i) {
    if (!turns(grains, i)) continue;
    TurningClump clump(grains, i);
    const Eigen::Vector3d before = clump.momentum_of(spin_of(grains, i)), gain = s.dt * kept_torque(s, i);
    clump.turn_freely(before + 0.5 * gain, s.dt);
    grains.set_orientation(i, clump.orientation());
    set_spin(grains, i, clump.spin_of(before + gain));
  }
}

void correct_clump_rotation(Integration& s, std::size_t from, std::size_t to) {
  Grains& grains = s.grains;
  for (std::size_t i = from; i < to; ++i) {
    if (!turns(grains, i)) continue;
    const Eigen::Vector3d missed = torque_of(s, i) - kept_torque(s, i);
    set_spin(grains, i, spin_of(grains, i) + TurningClump(grains, i).spin_of(0.5 * s.dt * missed));
    keep(s, i, torque_of(s, i));
  }
}

void keep_clump_rates(Integration& s, std::size_t from, std::size_t to) {
  const bool gear = s.model.scene.numerics.integrator == Integrator::gear5;
  for (std::size_t i = from; i < to; ++i) gear ? keep_rates_for_gear(s, i) : keep(s, i, torque_of(s, i));
}

void advance_clump_rotation(Integration& s, double dt, std::size_t from, std::size_t to) {
  Grains& grains = s.grains;
  for (std::size_t i = from; i < to; ++i) {
    if (!turns(grains, i)) continue;
    const Eigen::Vector3d present_spin = spin_of(grains, i);
    grains.set_orientation(i, s.orientation[i]);
    TurningClump clump(grains, i);
    const Eigen::Vector3d momentum = clump.momentum_of({s.omega_x[i], s.omega_y[i], s.omega[i]});
    clump.turn(present_spin, dt);
    grains.set_orientation(i, clump.orientation());
    set_spin(grains, i, clump.spin_of(momentum + dt * kept_torque(s, i)));
  }
}

void bring_to_unit_length(Grains& grains, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) grains.set_orientation(i, of_unit_length(grains.orientation(i)));
}

}  // namespace vibrosow
