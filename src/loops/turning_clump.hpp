#pragma once

#include "loops/orientation.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// How a rigid clump in 3D lies, and its principal moments of inertia (kg m2), along its own axes.
class TurningClump {
 public:
  [[gnu::always_inline]] TurningClump(const Orientation& orientation, const Vector3& inertia) : inertia_(inertia) {
    set(orientation);
  }

  [[gnu::always_inline]] const Orientation& orientation() const { return orientation_; }

  /// Angular momentum (kg m2/s) that goes with a spin (rad/s), and the other way round; both in the lab.
  [[gnu::always_inline]] Vector3 momentum_of(const Vector3& spin) const {
    const Vector3 own = along(axes_, spin);
    return in_lab(axes_, {own.x * inertia_.x, own.y * inertia_.y, own.z * inertia_.z});
  }
  [[gnu::always_inline]] Vector3 spin_of(const Vector3& momentum) const {
    const Vector3 own = along(axes_, momentum);
    return in_lab(axes_, {own.x / inertia_.x, own.y / inertia_.y, own.z / inertia_.z});
  }

  /// Turns on by the angle `spin` x dt about an axis of the lab, up to its third power (Cayley's rotation).
  [[gnu::always_inline]] void turn(const Vector3& spin, double dt) {
    const Vector3 half = (0.5 * dt) * spin;
    set(Orientation{1, half.x, half.y, half.z} * orientation_);
  }

  /// Turns on without torque, its angular momentum being `momentum` in the lab all along. Turns about the clump's own
  /// axes follow each other, half ones before and after: symmetric, symplectic and of second order (Touma & Wisdom,
  /// Astron. J. 107, 1189, 1994; Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107, 5840, 1997), so that the energy
  /// does not drift. Each by twice the arc tangent of half its angle, which leaves both so and takes no sine.
  [[gnu::always_inline]] void turn_freely(const Vector3& momentum, double dt) {
    Vector3 own = along(axes_, momentum);
    Orientation turned = orientation_;
    const auto about_x = [&](double time) {
      turned = turned * Orientation{1, half_turn(time, own.x, inertia_.x, own.y, own.z), 0, 0};
    };
    const auto about_y = [&](double time) {
      turned = turned * Orientation{1, 0, half_turn(time, own.y, inertia_.y, own.z, own.x), 0};
    };
    const auto about_z = [&](double time) {
      turned = turned * Orientation{1, 0, 0, half_turn(time, own.z, inertia_.z, own.x, own.y)};
    };
    // x, the long axis of a seed, about which it turns fastest, in the middle.
    about_z(0.5 * dt), about_y(0.5 * dt), about_x(dt), about_y(0.5 * dt), about_z(0.5 * dt);
    set(turned);
  }

 private:
  /// The tangent of half the angle by which the clump turns about an axis in that time. `u` and `v`, the momentum along
  /// the next two axes: what stands still in the lab turns the other way in the clump.
  [[gnu::always_inline]] static double half_turn(double time, double momentum, double inertia, double& u, double& v) {
    const double h = 0.5 * time * momentum / inertia;
    const double per = 1 / (1 + h * h), cosine = (1 - h * h) * per, sine = 2 * h * per;
    const double u_now = cosine * u + sine * v;
    v = cosine * v - sine * u, u = u_now;
    return h;
  }

  [[gnu::always_inline]] void set(const Orientation& orientation) {
    orientation_ = of_unit_length(orientation);
    axes_ = axes_of(orientation_);
  }

  Orientation orientation_;
  Axes axes_;
  Vector3 inertia_;
};

}  // namespace vibrosow::inline VIBROSOW_ISA
