#pragma once

#include <cmath>

namespace vibrosow {

/// Paper A's normal law: a rigid disc in a thin elastic shell of stiffness c = m g / eps, two shells in series
/// (Bogulskaya & Bogulsky 2020). Arguments in SI; a wall is a grain of compliance 0 and inverse mass 0.
struct ElasticShell {
  /// c_i c_j / (c_i + c_j), N/m, from the shells' compliances in m/N.
  template <class Real>
  static Real stiffness(Real compliance_i, Real compliance_j) {
    return Real(1) / (compliance_i + compliance_j);
  }

  /// Repulsion, N. For equal grains overlap m g / (2 eps), on a wall overlap m g / eps.
  template <class Real>
  static Real elastic_force(Real stiffness, Real overlap) {
    return stiffness * overlap;
  }

  /// Dashpot coefficient, N s/m, of a damping ratio: 2 zeta sqrt(k m*), 1/m* = 1/m_i + 1/m_j.
  template <class Real>
  static Real damping(Real damping_ratio, Real stiffness, Real inverse_mass_i, Real inverse_mass_j) {
    using std::sqrt;
    return Real(2) * damping_ratio * sqrt(stiffness / (inverse_mass_i + inverse_mass_j));
  }

  /// Stored in both shells, J.
  template <class Real>
  static Real elastic_energy(Real stiffness, Real overlap) {
    return Real(0.5) * stiffness * overlap * overlap;
  }
};

}  // namespace vibrosow
