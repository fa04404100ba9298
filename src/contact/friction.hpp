#pragma once

#include <algorithm>
#include <cmath>

#include "compute/instruction_set.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <class Real>
struct SlidingFriction {
  Real force;
  Real raised;  // 1 where the slip speed was raised and the force is smaller for it, else 0
};

/// Sliding friction `limit` sign(W) (paper A), made continuous: linear in the sliding speed below the slip speed. That
/// is raised to limit / steepest in a hard impact, so that no step turns the sliding round and back again. Also the
/// rolling torque of model A (Ai et al. 2011), of a limit in N m and a rolling speed. `yield` (s/kg) times the force is
/// how much slower the sliding is than `speed` by the time that counts.
template <class Real>
inline SlidingFriction<Real> sliding_friction(Real limit, Real speed, Real inverse_slip_speed, Real steepest,
                                              Real yield) {
  using std::abs, std::max, std::min;
  const Real slope = inverse_slip_speed / (Real(1) + limit * inverse_slip_speed * yield);
  const Real usual = limit * min(Real(1), max(Real(-1), speed * slope));
  const Real most = steepest / (Real(1) + steepest * yield) * speed;
  const bool raised = abs(most) < abs(usual);
  return {raised ? most : usual, raised ? Real(1) : Real(0)};
}

/// A spring and dashpot that hold up to `limit` (Cundall & Strack 1979): the force on a total displacement, which is
/// shortened to what the limit can hold where the contact slips. The dashpot never lengthens it: then the spring would
/// give back more than was put in. Also the rolling torque of model C (Ai et al. 2011), on the angle rolled. A
/// stiffness of 0 gives no displacement. `own`: the dashpot times the yield.
template <class Real>
inline Real spring_friction(Real stiffness, Real dashpot, Real limit, Real speed, Real own, Real& displacement) {
  using std::max, std::min;
  const auto within = [limit](Real force) { return min(limit, max(-limit, force)); };
  const Real elastic = stiffness * displacement, held = within(elastic);
  if (held != elastic) displacement = held / stiffness;
  if (!(stiffness > Real(0))) displacement = Real(0);
  return within((held + dashpot * speed) / (Real(1) + own));
}

}  // namespace vibrosow::inline VIBROSOW_ISA
