#pragma once

#include <cmath>

#include "compute/instruction_set.hpp"
#include "contact/surface_parameters.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Hertz' normal law F = (4/3) E* sqrt(R*) d^(3/2) (paper B, eq. 5). Arguments in SI; compliances are (1 - nu^2) / E in
/// 1/Pa, so that 1/E* is their sum; curvatures are 1/R. A rigid wall is a grain of compliance 0, a plane one of
/// curvature 0.
struct Hertz {
  /// k = (4/3) E* sqrt(R*), N/m^(3/2).
  template <class Real>
  static Real stiffness(Real compliance_i, Real compliance_j, Real curvature_i, Real curvature_j) {
    using std::sqrt;
    return Real(4.0 / 3.0) / ((compliance_i + compliance_j) * sqrt(curvature_i + curvature_j));
  }

  /// Elastic force over overlap, k sqrt(d), N/m.
  template <class Real>
  static Real secant(Real stiffness, Real overlap) {
    using std::sqrt;
    return stiffness * sqrt(overlap);
  }

  /// Damping zeta sqrt(5 m* k) d^(1/4): in u = d^(5/4) and a time that runs like d^(1/4) the impact is that of a linear
  /// spring and dashpot of damping ratio zeta, to the moment when the force has fallen to zero; so the restitution of
  /// zeta is the linear law's and no speed enters (form: Tsuji et al. 1992, Antypov & Elliott 2011).
  template <class Real>
  static Real dashpot(const SurfaceParameters& surface, Real stiffness, Real inverse_mass_i, Real inverse_mass_j) {
    using std::sqrt;
    return surface.damping_ratio * sqrt(Real(5) * stiffness / (inverse_mass_i + inverse_mass_j));
  }
  template <class Real>
  static Real dashpot_at(Real dashpot, Real overlap) {
    using std::sqrt;
    return dashpot * sqrt(sqrt(overlap));
  }

  /// (2/5) k d^(5/2), J.
  template <class Real>
  static Real elastic_energy(Real stiffness, Real overlap) {
    using std::sqrt;
    return Real(0.4) * stiffness * overlap * overlap * sqrt(overlap);
  }
};

/// Hertz' law with paper B's damping -gamma_n M* v_n (eq. 6); the restitution then depends on the speed of impact.
struct HertzViscous : Hertz {
  template <class Real>
  static Real dashpot(const SurfaceParameters& surface, Real /*stiffness*/, Real inverse_mass_i, Real inverse_mass_j) {
    return surface.damping_rate / (inverse_mass_i + inverse_mass_j);
  }
  template <class Real>
  static Real dashpot_at(Real dashpot, Real /*overlap*/) {
    return dashpot;
  }
};

}  // namespace vibrosow::inline VIBROSOW_ISA
