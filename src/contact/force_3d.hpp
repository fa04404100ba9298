#pragma once

#include <algorithm>
#include <cmath>

#include "compute/vector3.hpp"
#include "contact/contact_force.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// How two surfaces stand and move in 3D. n is the unit vector from i to j.
struct Touch3d {
  double overlap = 0;   // m
  double approach = 0;  // m/s, growth of the overlap
  Vector3 n;
  Vector3 sliding;           // m/s, W: velocity of i's surface over j's, across n
  Vector3 slipping;          // m/s, the same on the mean over the step: set where there is a history
  double nearer = 0;         // m, by how much less the two overlapped in the middle of the step
  double sliding_yield = 0;  // 1/kg, how fast a force of 1 changes the sliding
  Vector3 turning;           // rad/s, omega_i - omega_j, across n
  double twisting = 0;       // rad/s, the same along n
  double spin = 0;           // rad/s, of both together about n: their mean
  Vector3 normal_rate;       // rad/s, how fast n turns as the two pass each other: of a wall's, 0
};

/// Two that roll over each other.
struct Turning {
  Vector3 omega_i, omega_j;  // rad/s
  double arm_i, arm_j;       // m
  double per_distance;       // 1/m, of the centres; 0 at a wall, whose normal does not turn as the grain moves along it
  double shortening;         // of the arms, by the overlap
};

/// Sets what of `touch` the effects ask for, and adds to its sliding, slipping and yield. In the middle of the step,
/// `lag` ago, arms were longer, and normal and grains had not turned as far: the slipping is carried on to now.
template <class Effects>
inline void set_turning(const Turning& turning, const PairConstants& pair, double lag, Touch3d& touch) {
  const auto& [omega_i, omega_j, arm_i, arm_j, per_distance, shortening] = turning;
  touch.sliding_yield += arm_i * arm_i * pair.turning_yield_i + arm_j * arm_j * pair.turning_yield_j;
  touch.sliding = touch.sliding + cross(arm_i * omega_i + arm_j * omega_j, touch.n);
  [[maybe_unused]] const double turns = lag * per_distance;
  if constexpr (keeps_history<Effects>) {
    const Vector3 both = omega_i + omega_j;
    touch.spin = 0.5 * (dot(both, touch.n) + turns * dot(both, touch.slipping));
  }
  if constexpr (Effects::spring) {
    const double longer = shortening * touch.nearer;
    const Vector3 rims =
        (arm_i + longer * pair.overlap_fraction_i) * omega_i + (arm_j + longer * pair.overlap_fraction_j) * omega_j;
    const Vector3 along = touch.slipping;
    touch.slipping = (1 - touch.nearer * per_distance) * along + cross(rims, touch.n);
    touch.slipping =
        touch.slipping + cross(touch.n, (turns * dot(rims, touch.n)) * along + (lag * touch.spin) * touch.slipping);
  }
  if constexpr (Effects::rolls) {
    const Vector3 relative = omega_i - omega_j;
    touch.twisting = dot(relative, touch.n);
    touch.turning = relative - touch.twisting * touch.n;
  }
}

/// History of one contact in 3D. The displacements lie across the normal of the moment when they were stored, and
/// are seen from the list's grain.
struct History3d {
  Vector3 slip;      // m, displacement of the tangential spring
  Vector3 roll;      // rad, of the rolling spring
  double twist = 0;  // rad, of the twisting spring
};

struct ContactForce3d {
  double normal;       // N, repulsion; below zero only by cohesion
  Vector3 tangential;  // N, on i
  Vector3 resistance;  // N m, on i, of rolling and twisting; the opposite acts on j
  double slip_raised;  // 1 where a slip speed was raised, else 0
};

/// Carries a vector that lay across a contact's normal on to its normal of now, by the rotation of the two together:
/// the smallest that takes the one normal to the other, then the spin about it. To the second order in the angles of a
/// step; what comes out lies across the normal at any angle.
class Carrier {
 public:
  Carrier(const Touch3d& touch, double step)
      : n_(touch.n),
        middle_(touch.n - 0.5 * step * touch.normal_rate),
        angle_(step * touch.spin),
        cosine_(1 - 0.5 * angle_ * angle_) {}
  Vector3 operator()(const Vector3& a) const {
    const Vector3 turned = a - dot(a, n_) * middle_;
    return cosine_ * turned + angle_ * cross(n_, turned);
  }

 private:
  Vector3 n_, middle_;
  double angle_, cosine_;
};

/// A displacement across the contact's normal between two evaluations: read, carried, moved on, and stored.
class MovingVector {
 public:
  MovingVector(const Vector3& stored, const Vector3& speed, const Carrier& carry, const ContactStep& step)
      : displacement(carry(stored) + step.trial * speed), rest_((step.commit - step.trial) * speed) {}

  Vector3 displacement;  // at which the force is wanted; the law may shorten it

  Vector3 to_store() const { return displacement + rest_; }

 private:
  Vector3 rest_;
};

/// `limit` against the direction of a velocity, made continuous as in 2D.
struct Sliding3d {
  Vector3 force;
  double raised;
};
[[gnu::always_inline]] inline Sliding3d sliding_friction(double limit, const Vector3& speed, double inverse_slip_speed,
                                                         double steepest, double yield) {
  const double size = length(speed);
  const double slope = inverse_slip_speed / (1 + limit * inverse_slip_speed * yield);
  // The plane's limit min(1, |W| / v_s) over |W|.
  const double usual = limit * std::min(slope, 1 / std::max(size, 1e-300)), most = steepest / (1 + steepest * yield);
  const bool raised = most < usual && size > 0;
  return {(raised ? most : usual) * speed, raised ? 1.0 : 0.0};
}

/// As in 2D; at slip the displacement is shortened without changing its direction.
[[gnu::always_inline]] inline Vector3 spring_friction(double stiffness, double dashpot, double limit,
                                                      const Vector3& speed, double own, Vector3& displacement) {
  const Vector3 elastic = stiffness * displacement;
  const auto within = [limit](const Vector3& force) { return std::min(1.0, limit / length(force)); };
  const double held = within(elastic) * (stiffness > 0 ? 1.0 : 0.0);
  displacement = held * displacement;
  const Vector3 both = (1 / (1 + own)) * (held * elastic + dashpot * speed);
  return within(both) * both;
}

/// Of two flags, each 0 or 1. (g++ 12 breaks down over the larger of several such.)
inline double logical_or(double a, double b) {
  return a + b - a * b;
}

/// Torque (N m) of model C against twisting, with an arm of its own; moves the history on.
[[gnu::always_inline]] inline double twisting_torque(const Touch3d& touch, const PairConstants& pair,
                                                     const SurfaceParameters& surface, const NormalForce& normal,
                                                     const ContactStep& step, History3d& history) {
  const double arm = surface.twisting_friction * pair.rolling_radius;
  const double stiffness = 2.25 * normal.secant * arm * arm;
  const double critical = 2 * std::sqrt(pair.twisting_inertia * stiffness);
  MovingHistory twist(history.twist, touch.twisting, step);
  const double damping = surface.rolling_damping * critical;
  const double torque = spring_friction(stiffness, damping, arm * normal.repulsion, touch.twisting,
                                        damping * step.lag * pair.turning_yield(), twist.displacement);
  history.twist = twist.to_store();
  return torque;
}

/// Force of one contact in 3D, of the same laws as in 2D. `history` goes in as it was stored and comes out as
/// it is to be stored.
template <class Law, class Effects>
[[gnu::always_inline]] inline ContactForce3d contact_force_3d(const Touch3d& touch, const PairConstants& pair,
                                                              const SurfaceParameters& surface, const ContactStep& step,
                                                              History3d& history) {
  const NormalForce normal = normal_force<Law, Effects>(touch.overlap, touch.approach, pair, surface, step);
  ContactForce3d force{normal.repulsion, {}, {}, 0};
  if constexpr (Effects::cohesion) force.normal -= surface.cohesion;
  [[maybe_unused]] const Carrier carry(touch, step.commit);
  if constexpr (Effects::spring) {
    MovingVector slip(history.slip, touch.slipping, carry, step);
    force.tangential =
        -1 * spring_friction(surface.tangential_ratio * normal.secant, surface.tangential_damping * normal.dashpot,
                             surface.friction * normal.repulsion, touch.sliding,
                             surface.tangential_damping * normal.own_dashpot * step.lag * touch.sliding_yield,
                             slip.displacement);
    history.slip = slip.to_store();
  } else if constexpr (Effects::friction) {
    const auto sliding =
        sliding_friction(surface.friction * normal.repulsion, touch.sliding, surface.inverse_slip_speed,
                         pair.steepest_sliding, step.lag * touch.sliding_yield);
    force.tangential = -1 * sliding.force, force.slip_raised = sliding.raised;
  }
  if constexpr (Effects::rolling == Rolling::constant_torque) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    const auto rolling = sliding_friction(arm * normal.repulsion, pair.rolling_radius * touch.turning,
                                          surface.inverse_slip_speed, pair.steepest_rolling, 0.0);
    const auto twisting =
        sliding_friction(surface.twisting_friction * pair.rolling_radius * normal.repulsion,
                         pair.rolling_radius * touch.twisting, surface.inverse_slip_speed, pair.steepest_rolling, 0.0);
    force.resistance = -1 * rolling.force - twisting.force * touch.n;
    force.slip_raised = logical_or(force.slip_raised, logical_or(rolling.raised, twisting.raised));
  } else if constexpr (Effects::rolling == Rolling::spring) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    const double stiffness = 2.25 * normal.secant * arm * arm;
    const double critical = 2 * std::sqrt(pair.rolling_inertia * stiffness);
    MovingVector roll(history.roll, touch.turning, carry, step);
    const double damping = surface.rolling_damping * critical;
    force.resistance = -1 * spring_friction(stiffness, damping, arm * normal.repulsion, touch.turning,
                                            damping * step.lag * pair.turning_yield(), roll.displacement);
    history.roll = roll.to_store();
    force.resistance = force.resistance - twisting_torque(touch, pair, surface, normal, step, history) * touch.n;
  }
  return force;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
