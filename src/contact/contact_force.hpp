#pragma once

#include <algorithm>
#include <cmath>

#include "compute/instruction_set.hpp"
#include "contact/compiled_effects.hpp"
#include "contact/contact_history.hpp"
#include "contact/friction.hpp"
#include "laws/surface_parameters.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <class Effects>
inline constexpr bool keeps_history = Effects::spring || Effects::rolling == Rolling::spring;

/// Whether a slip speed makes something continuous.
template <class Effects>
inline constexpr bool regularised = (Effects::friction && !Effects::spring) || Effects::rolling
                                                                                   == Rolling::constant_torque;

/// What stays the same for two surfaces as long as they touch. Members of an absent effect are not set.
struct PairConstants {
  double reach;                                   // m, r_i + r_j
  double stiffness;                               // of the law
  double dashpot;                                 // of the law
  double overlap_fraction_i, overlap_fraction_j;  // of the overlap
  double relative_per_overlap;
  double steepest_sliding;  // N s/m, of sliding friction
  double rolling_radius;    // m, 1 / (1/r_i + 1/r_j)
  double steepest_rolling;  // N s, of a constant rolling torque by the rolling speed
  double rolling_inertia;   // kg m2, of turning about the contact
  double twisting_inertia;  // kg m2, of the two about their common normal
  // How fast a force of 1 changes the approach, and a torque of 1 how each of the two turns, 1/kg and 1/(kg m2).
  double approach_yield, turning_yield_i, turning_yield_j;
  double brake_yield;  // 1/kg, by which drag slows down the two against each other

  double turning_yield() const { return turning_yield_i + turning_yield_j; }
};

/// How two surfaces stand and move.
struct Touch {
  double overlap;        // m
  double approach;       // m/s, growth of the overlap
  double sliding;        // m/s, W: speed of i's surface over j's along t
  double turning;        // rad/s, omega_i - omega_j
  double slipping;       // m/s, as sliding, on the mean over the step: set where there is a spring
  double sliding_yield;  // 1/kg, how fast a force of 1 changes the sliding
};

/// A displacement between two evaluations: read, moved on, and stored.
class MovingHistory {
 public:
  MovingHistory(double stored, double speed, const ContactStep& step)
      : displacement(stored + step.trial * speed), rest_((step.commit - step.trial) * speed) {}

  double displacement;  // at which the force is wanted; the law may shorten it

  double to_store() const { return displacement + rest_; }

 private:
  double rest_;
};

/// What a law and its dashpot make of an overlap: together they never pull.
struct NormalForce {
  double secant;       // N/m, of the elastic force
  double dashpot;      // N s/m, as long as it acts; 0 without damping
  double own_dashpot;  // N s/m, at the overlap: by which its own force changes what it takes
  double repulsion;    // N
};
template <class Law, class Effects>
[[gnu::always_inline]] inline NormalForce normal_force(double overlap, double approach, const PairConstants& pair,
                                                       const SurfaceParameters& surface, const ContactStep& step) {
  const double secant = Law::secant(pair.stiffness, overlap);
  double repulsion = secant * overlap, dashpot = 0, own = 0;
  if constexpr (Effects::damping) {
    // A contact that begins in this step has touched for overlap / approach of it. Its force counts for all of a step
    // from the middle of this one on; the dashpot then for the time in touch, which is longer or shorter.
    const double in_half_step = step.lag * approach, before = overlap - in_half_step;
    const bool begins = before < in_half_step;
    own = Law::dashpot_at(pair.dashpot, overlap);
    dashpot = begins ? Law::dashpot_impulse(pair.dashpot, overlap + in_half_step) / (in_half_step + in_half_step) : own;
    const double yield = step.lag * pair.approach_yield;
    double later = approach;
    if constexpr (Effects::cohesion) later += surface.cohesion * yield;
    const double trial = (repulsion + dashpot * later) / (1 + own * yield);
    repulsion = std::max(0.0, trial);
  }
  return {secant, dashpot, own, repulsion};
}

struct ContactForce {
  double normal;       // N, repulsion; below zero only by cohesion
  double tangential;   // N, on i along -t; positive opposes a positive sliding speed
  double rolling;      // N m, on i; the opposite acts on j
  double slip_raised;  // 1 where a slip speed was raised, else 0
};

/// Force of one contact. Cohesion pulls beside the normal force and does not add to friction's limit. Its history goes
/// in as it was stored and comes out as it is to be stored: two numbers, since g++ keeps a struct of them in memory,
/// and then makes no vectors.
template <class Law, class Effects>
inline ContactForce contact_force(const Touch& touch, const PairConstants& pair, const SurfaceParameters& surface,
                                  const ContactStep& step, double& slip, double& roll) {
  [[maybe_unused]] const auto [secant, dashpot, own_dashpot, repulsion] =
      normal_force<Law, Effects>(touch.overlap, touch.approach, pair, surface, step);
  ContactForce force{repulsion, 0, 0, 0};
  if constexpr (Effects::cohesion) force.normal -= surface.cohesion;
  if constexpr (Effects::spring) {
    MovingHistory moving(slip, touch.slipping, step);
    force.tangential = spring_friction(
        surface.tangential_ratio * secant, surface.tangential_damping * dashpot, surface.friction * repulsion,
        touch.sliding, surface.tangential_damping * own_dashpot * step.lag * touch.sliding_yield, moving.displacement);
    slip = moving.to_store();
  } else if constexpr (Effects::friction) {
    const auto sliding = sliding_friction(surface.friction * repulsion, touch.sliding, surface.inverse_slip_speed,
                                          pair.steepest_sliding, step.lag * touch.sliding_yield);
    force.tangential = sliding.force, force.slip_raised = sliding.raised;
  }
  if constexpr (Effects::rolling == Rolling::constant_torque) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    const auto rolling = sliding_friction(arm * repulsion, pair.rolling_radius * touch.turning,
                                          surface.inverse_slip_speed, pair.steepest_rolling, 0.0);
    force.rolling = -rolling.force, force.slip_raised = std::max(force.slip_raised, rolling.raised);
  } else if constexpr (Effects::rolling == Rolling::spring) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    const double stiffness = 2.25 * secant * arm * arm;
    const double critical = 2 * std::sqrt(pair.rolling_inertia * stiffness);
    MovingHistory moving(roll, touch.turning, step);
    const double damping = surface.rolling_damping * critical;
    force.rolling = -spring_friction(stiffness, damping, arm * repulsion, touch.turning,
                                     damping * step.lag * pair.turning_yield(), moving.displacement);
    roll = moving.to_store();
  }
  return force;
}

template <class Effects>
inline double stored_slip(const ContactHistories& histories, std::size_t k) {
  if constexpr (Effects::spring) return histories.slip[k];
  return 0;
}
template <class Effects>
inline double stored_roll(const ContactHistories& histories, std::size_t k) {
  if constexpr (Effects::rolling == Rolling::spring) return histories.roll[k];
  return 0;
}

/// Energy of the springs of one contact, J; cohesion counts from the moment of touch.
template <class Law, class Effects>
inline double contact_energy(double overlap, const PairConstants& pair, const SurfaceParameters& surface, double slip,
                             double roll) {
  double energy = Law::elastic_energy(pair.stiffness, overlap);
  [[maybe_unused]] const double secant = Law::secant(pair.stiffness, overlap);
  if constexpr (Effects::cohesion) energy -= surface.cohesion * overlap;
  if constexpr (Effects::spring) energy += 0.5 * surface.tangential_ratio * secant * slip * slip;
  if constexpr (Effects::rolling == Rolling::spring) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    energy += 0.5 * 2.25 * secant * arm * arm * roll * roll;
  }
  return energy;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
