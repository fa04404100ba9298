#pragma once

#include <cmath>

#include "compute/instruction_set.hpp"
#include "contact/surface_parameters.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Paper A's normal law: a rigid disc in a thin elastic shell of stiffness c = m g / eps, two shells in series
/// (Bogulskaya & Bogulsky 2020). Arguments in SI; compliances are 1 / c in m/N; a wall is a grain of compliance 0,
/// inverse mass 0 and curvature 0.
struct ElasticShell {
  /// c_i c_j / (c_i + c_j), N/m.
  template <class Real>
  static Real stiffness(Real compliance_i, Real compliance_j, Real /*curvature_i*/, Real /*curvature_j*/) {
    return Real(1) / (compliance_i + compliance_j);
  }

  /// Elastic force over overlap, N/m. For equal grains m g / (2 eps), on a wall m g / eps.
  template <class Real>
  static Real secant(Real stiffness, Real /*overlap*/) {
    return stiffness;
  }

  /// Dashpot coefficient, N s/m, of a damping ratio: 2 zeta sqrt(k m*), 1/m* = 1/m_i + 1/m_j.
  template <class Real>
  static Real dashpot(const SurfaceParameters& surface, Real stiffness, Real inverse_mass_i, Real inverse_mass_j) {
    using std::sqrt;
    return Real(2) * surface.damping_ratio * sqrt(stiffness / (inverse_mass_i + inverse_mass_j));
  }
  template <class Real>
  static Real dashpot_at(Real dashpot, Real /*overlap*/) {
    return dashpot;
  }

  /// Stored in both shells, J.
  template <class Real>
  static Real elastic_energy(Real stiffness, Real overlap) {
    return Real(0.5) * stiffness * overlap * overlap;
  }
};

}  // namespace vibrosow::inline VIBROSOW_ISA
