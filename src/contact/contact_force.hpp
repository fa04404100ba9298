#pragma once

#include <algorithm>
#include <cmath>

#include "contact/contact_history.hpp"
#include "contact/friction.hpp"
#include "contact/surface_parameters.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

enum class FrictionChoice { none, sliding, spring };

/// Effects that enter the contact force, as a compile-time choice. Rotation needs friction, rolling needs rotation.
template <FrictionChoice friction_, bool rotation_, bool damping_, bool unequal_, Rolling rolling_, bool cohesion_>
struct PairEffects {
  static constexpr bool friction = friction_ != FrictionChoice::none;
  static constexpr bool spring = friction_ == FrictionChoice::spring;
  static constexpr bool rotation = rotation_, damping = damping_, unequal = unequal_;
  static constexpr Rolling rolling = rolling_;
  static constexpr bool rolls = rolling_ != Rolling::none;
  static constexpr bool cohesion = cohesion_;
};

/// What stays the same for two surfaces as long as they touch.
struct PairConstants {
  double reach;             // m, r_i + r_j
  double stiffness;         // of the law
  double dashpot;           // of the law
  double share_i, share_j;  // of the overlap
  double compression_per_overlap;
  double rolling_radius;   // m, 1 / (1/r_i + 1/r_j)
  double rolling_inertia;  // kg m2, of turning about the contact
};

/// How two surfaces stand and move.
struct Touch {
  double overlap;   // m
  double approach;  // m/s, growth of the overlap
  double sliding;   // m/s, W: speed of i's surface over j's along t
  double turning;   // rad/s, omega_i - omega_j
};

struct ContactForce {
  double normal;      // N, repulsion; below zero only by cohesion
  double tangential;  // N, on i along -t; positive opposes a positive sliding speed
  double rolling;     // N m, on i; the opposite acts on j
};

/// Force of one contact. Elastic and damping force together never pull; cohesion pulls beside them and does not add to
/// friction's limit. `memory` is entry `k` of the list's history.
template <class Law, class Effects>
inline ContactForce contact_force(const Touch& touch, const PairConstants& pair, const SurfaceParameters& surface,
                                  const HistoryAdvance& advance, ContactHistory& memory, std::size_t k) {
  const double secant = Law::secant(pair.stiffness, touch.overlap);
  double repulsion = secant * touch.overlap;
  [[maybe_unused]] double dashpot = 0;
  if constexpr (Effects::damping) {
    dashpot = Law::dashpot_at(pair.dashpot, touch.overlap);
    repulsion = std::max(0.0, repulsion + dashpot * touch.approach);
  }
  ContactForce force{repulsion, 0, 0};
  if constexpr (Effects::cohesion) force.normal -= surface.cohesion;
  if constexpr (Effects::spring) {
    MovingHistory slip(memory.slip[k], memory.slip_speed[k], touch.sliding, advance);
    force.tangential = spring_friction(surface.tangential_ratio * secant, surface.tangential_damping * dashpot,
                                       surface.friction * repulsion, touch.sliding, slip.displacement);
    if (advance.commit > 0) memory.slip[k] = slip.to_store(advance), memory.slip_speed[k] = touch.sliding;
  } else if constexpr (Effects::friction) {
    force.tangential = sliding_friction(surface.friction * repulsion, touch.sliding, surface.inverse_slip_speed);
  }
  if constexpr (Effects::rolling == Rolling::constant_torque) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    force.rolling = -sliding_friction(arm * repulsion, pair.rolling_radius * touch.turning, surface.inverse_slip_speed);
  } else if constexpr (Effects::rolling == Rolling::spring) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    const double stiffness = 2.25 * secant * arm * arm;
    const double critical = 2 * std::sqrt(pair.rolling_inertia * stiffness);
    MovingHistory roll(memory.roll[k], memory.roll_speed[k], touch.turning, advance);
    force.rolling = -spring_friction(stiffness, surface.rolling_damping * critical, arm * repulsion, touch.turning,
                                     roll.displacement);
    if (advance.commit > 0) memory.roll[k] = roll.to_store(advance), memory.roll_speed[k] = touch.turning;
  }
  return force;
}

/// Nothing touches at entry `k`: it forgets.
template <class Effects>
inline void forget_contact(const HistoryAdvance& advance, ContactHistory& memory, std::size_t k) {
  if (!(advance.commit > 0)) return;
  if constexpr (Effects::spring) memory.slip[k] = memory.slip_speed[k] = 0;
  if constexpr (Effects::rolling == Rolling::spring) memory.roll[k] = memory.roll_speed[k] = 0;
}

/// Energy of the springs of one contact, J; cohesion counts from the moment of touch.
template <class Law, class Effects>
inline double contact_energy(double overlap, const PairConstants& pair, const SurfaceParameters& surface,
                             const ContactHistory& memory, std::size_t k) {
  double energy = Law::elastic_energy(pair.stiffness, overlap);
  [[maybe_unused]] const double secant = Law::secant(pair.stiffness, overlap);
  if constexpr (Effects::cohesion) energy -= surface.cohesion * overlap;
  if constexpr (Effects::spring) energy += 0.5 * surface.tangential_ratio * secant * memory.slip[k] * memory.slip[k];
  if constexpr (Effects::rolling == Rolling::spring) {
    const double arm = surface.rolling_friction * pair.rolling_radius;
    energy += 0.5 * 2.25 * secant * arm * arm * memory.roll[k] * memory.roll[k];
  }
  return energy;
}

}  // namespace vibrosow
