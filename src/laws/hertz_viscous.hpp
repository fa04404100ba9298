#pragma once

#include "laws/hertz.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Hertz' law with paper B's damping -gamma_n M* v_n (eq. 6); the restitution then depends on the speed of impact.
struct HertzViscous : Hertz {
  static constexpr std::string_view description = "Hertz, damping by a rate (paper B)";
  static constexpr LawDamping damping = LawDamping::rate;

  template <class Real>
  static Real dashpot(const SurfaceParameters& surface, Real /*stiffness*/, Real inverse_mass_i, Real inverse_mass_j) {
    return surface.damping_rate / (inverse_mass_i + inverse_mass_j);
  }
  template <class Real>
  static Real dashpot_at(Real dashpot, Real /*overlap*/) {
    return dashpot;
  }
  template <class Real>
  static Real dashpot_impulse(Real dashpot, Real overlap) {
    return dashpot * overlap;
  }

  static double damping_ratio(const SurfaceParameters& surface, double omega) {
    return surface.damping_rate / (2 * omega);
  }
};

template <>
struct FormulasOf<Law::hertz_viscous> {
  using Type = HertzViscous;
};

}  // namespace vibrosow::inline VIBROSOW_ISA
