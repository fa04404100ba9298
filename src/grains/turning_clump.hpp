#pragma once

#include <Eigen/Core>

#include "grains/grains.hpp"

namespace vibrosow {

/// How a rigid clump in space lies, and its inertia. It can turn (GrainKind::inverse_inertia > 0).
class TurningClump {
 public:
  TurningClump(const Grains& grains, std::size_t i);

  const Orientation& orientation() const { return orientation_; }
  /// Angular momentum (kg m2/s) that goes with a spin (rad/s), and the other way round; both in the lab.
  Eigen::Vector3d momentum_of(const Eigen::Vector3d& spin) const;
  Eigen::Vector3d spin_of(const Eigen::Vector3d& momentum) const;

  /// Turns on by the angle `spin` x dt about an axis of the lab, up to its third power (Cayley's rotation).
  void turn(const Eigen::Vector3d& spin, double dt);

  /// Turns on without torque, its angular momentum being `momentum` in the lab all along. Turns about the clump's own
  /// axes follow each other, half ones before and after: symmetric, symplectic and of second order (Touma & Wisdom,
  /// Astron. J. 107, 1189, 1994; Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107, 5840, 1997), so that the energy
  /// does not drift. Each by twice the arc tangent of half its angle, which leaves both so and takes no sine.
  void turn_freely(const Eigen::Vector3d& momentum, double dt);

 private:
  void set(const Orientation& orientation);

  Orientation orientation_;
  Eigen::Matrix3d axes_;     // in the lab, by columns
  Eigen::Vector3d inertia_;  // kg m2, principal
};

Eigen::Vector3d spin_of(const Grains& grains, std::size_t i);
void set_spin(Grains& grains, std::size_t i, const Eigen::Vector3d& spin);

/// Whether the grains are clumps in space, which turn by their quaternions.
inline bool turn_as_clumps(const Grains& grains) {
  return grains.in_space && grains.oriented && grains.rotation;
}

}  // namespace vibrosow
