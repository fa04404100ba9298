#include "grains/turning_clump.hpp"

namespace vibrosow {

TurningClump::TurningClump(const Grains& grains, std::size_t i) {
  const GrainKind kind = grains.kind(i);
  inertia_ = Eigen::Vector3d(kind.moments[0], kind.moments[1], kind.moments[2]) / kind.inverse_inertia;
  set(grains.orientation(i));
}

void TurningClump::set(const Orientation& orientation) {
  orientation_ = of_unit_length(orientation);
  axes_ = rotation_matrix(orientation_);
}

Eigen::Vector3d TurningClump::momentum_of(const Eigen::Vector3d& spin) const {
  return axes_ * (axes_.transpose() * spin).cwiseProduct(inertia_);
}

Eigen::Vector3d TurningClump::spin_of(const Eigen::Vector3d& momentum) const {
  return axes_ * (axes_.transpose() * momentum).cwiseQuotient(inertia_);
}

void TurningClump::turn(const Eigen::Vector3d& spin, double dt) {
  const Eigen::Vector3d half = 0.5 * dt * spin;
  set(Orientation{1, half.x(), half.y(), half.z()} * orientation_);
}

void TurningClump::turn_freely(const Eigen::Vector3d& momentum, double dt) {
  Eigen::Vector3d own = axes_.transpose() * momentum;
  Orientation turned = orientation_;
  const auto turn_about = [&](Eigen::Index axis, double time) {
    const double h = 0.5 * time * own[axis] / inertia_[axis];
    const double per = 1 / (1 + h * h), cosine = (1 - h * h) * per, sine = 2 * h * per;
    // What stands still in the lab turns the other way in the clump.
    double &u = own[(axis + 1) % 3], &v = own[(axis + 2) % 3];
    const double u_now = cosine * u + sine * v;
    v = cosine * v - sine * u, u = u_now;
    turned = turned * Orientation{1, axis == 0 ? h : 0, axis == 1 ? h : 0, axis == 2 ? h : 0};
  };
  // x, the long axis of a seed, about which it turns fastest, in the middle.
  turn_about(2, 0.5 * dt), turn_about(1, 0.5 * dt), turn_about(0, dt), turn_about(1, 0.5 * dt), turn_about(2, 0.5 * dt);
  set(turned);
}

Eigen::Vector3d spin_of(const Grains& grains, std::size_t i) {
  return {grains.omega_x[i], grains.omega_y[i], grains.omega[i]};
}

void set_spin(Grains& grains, std::size_t i, const Eigen::Vector3d& spin) {
  grains.omega_x[i] = spin.x(), grains.omega_y[i] = spin.y(), grains.omega[i] = spin.z();
}

}  // namespace vibrosow
