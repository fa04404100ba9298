#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "compute/instruction_set.hpp"
#include "laws/law.hpp"
#include "laws/materials.hpp"
#include "laws/surface_parameters.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Paper A's normal law: a rigid disc in a thin elastic shell of stiffness c = m g / eps, two shells in series
/// (Bogulskaya & Bogulsky 2020). Arguments in SI; compliances are 1 / c in m/N; a wall is a grain of compliance 0,
/// inverse mass 0 and curvature 0.
struct ElasticShell {
  static constexpr std::string_view name = "elastic-shell";
  static constexpr std::string_view description =
      "thin elastic shell on a rigid core, linear (Bogulskaya & Bogulsky 2020)";
  static constexpr LawMaterial material = LawMaterial::shell;
  static constexpr LawDamping damping = LawDamping::restitution;
  static constexpr bool duration_depends_on_speed = false;

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
  /// What the dashpot has taken from 0 to an overlap, N s: the integral of `dashpot_at`.
  template <class Real>
  static Real dashpot_impulse(Real dashpot, Real overlap) {
    return dashpot * overlap;
  }

  /// Stored in both shells, J.
  template <class Real>
  static Real elastic_energy(Real stiffness, Real overlap) {
    return Real(0.5) * stiffness * overlap * overlap;
  }

  /// eps / (m g), m/N.
  static double compliance(const SeedMaterial& seed) { return seed.shell_compression * seed.radius / seed.weight; }
  /// A wall's shell is rigid.
  static double wall_compliance(const std::optional<ElasticMaterial>& /*wall*/) { return 0; }
  /// eps / r under its own weight stays: eps grows with the size, the weight with the mass.
  static double compliance_of_size(double compliance, double size, double mass_growth) {
    return compliance * size / mass_growth;
  }

  /// k_t / k_n, as given; where nothing is, Mindlin's 2 (1 - nu) / (2 - nu) at nu = 0.3: the shell has no nu of its
  /// own.
  static double tangential_ratio(const RubbingMaterials& /*materials*/, const std::optional<double>& given) {
    return given.value_or(14.0 / 17);
  }

  /// Largest overlap (m) of an elastic impact at `speed`: V / omega, omega^2 = k / m*.
  static double impact_overlap(double stiffness, double inverse_mass, double speed) {
    return speed / std::sqrt(stiffness * inverse_mass);
  }
  /// How long it lasts, s: half a period.
  static double impact_duration(double stiffness, double inverse_mass, double /*speed*/) {
    return std::numbers::pi / std::sqrt(stiffness * inverse_mass);
  }
  /// Overlap (m) under a force at rest.
  static double static_overlap(double stiffness, double force) { return force / stiffness; }
  /// dF/dd at an overlap, N/m.
  static double slope(double stiffness, double /*overlap*/) { return stiffness; }
  static constexpr double slope_over_secant = 1;
  /// Damping ratio of a contact that vibrates at `omega` (rad/s).
  static double damping_ratio(const SurfaceParameters& surface, double /*omega*/) { return surface.damping_ratio; }
};

template <>
struct FormulasOf<Law::elastic_shell> {
  using Type = ElasticShell;
};

}  // namespace vibrosow::inline VIBROSOW_ISA
