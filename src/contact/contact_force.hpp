#pragma once

#include <algorithm>

namespace vibrosow {

/// What two surfaces do to each other, ready for the inner loop.
struct SurfaceParameters {
  double friction = 0;
  double inverse_slip_speed = 0;  // s/m
  double damping_ratio = 0;       // of the normal dashpot, from the restitution
};

template <class Real>
struct ContactForce {
  Real normal;      // N, repulsion, never negative
  Real tangential;  // N, on i along -t; positive opposes a positive sliding speed
};

/// Force of one contact. `approach` (m/s) is the rate at which the overlap grows, `sliding` (m/s) the speed W of i's
/// surface over j's along t. The normal force never pulls. Sliding friction nu F_n sign(W) (paper A) is made continuous
/// below the slip speed v_s: nu F_n min(1, |W| / v_s) sign(W).
template <class Law, bool with_friction, bool with_damping, class Real>
inline ContactForce<Real> contact_force(Real overlap, Real approach, Real sliding, Real stiffness, Real damping,
                                        const SurfaceParameters& surface) {
  using std::max, std::min;
  Real normal = Law::elastic_force(stiffness, overlap);
  if constexpr (with_damping) normal = max(Real(0), normal + damping * approach);
  Real tangential = Real(0);
  if constexpr (with_friction) {
    const Real slip = min(Real(1), max(Real(-1), sliding * Real(surface.inverse_slip_speed)));
    tangential = Real(surface.friction) * normal * slip;
  }
  return {normal, tangential};
}

}  // namespace vibrosow
