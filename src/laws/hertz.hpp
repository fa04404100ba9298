#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "compute/instruction_set.hpp"
#include "laws/law.hpp"
#include "laws/materials.hpp"
#include "laws/surface_parameters.hpp"
#include "portable_math/functions.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Hertz' normal law F = (4/3) E* sqrt(R*) d^(3/2) (paper B, eq. 5). Arguments in SI; compliances are (1 - nu^2) / E in
/// 1/Pa, so that 1/E* is their sum; curvatures are 1/R. A rigid wall is a grain of compliance 0, a plane one of
/// curvature 0.
struct Hertz {
  static constexpr std::string_view name = "hertz";
  static constexpr std::string_view description = "Hertz, damping from the restitution";
  static constexpr LawMaterial material = LawMaterial::elastic;
  static constexpr LawDamping damping = LawDamping::restitution;
  static constexpr bool duration_depends_on_speed = true;

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
  /// What the dashpot has taken from 0 to an overlap, N s: the integral of `dashpot_at`.
  template <class Real>
  static Real dashpot_impulse(Real dashpot, Real overlap) {
    using std::sqrt;
    return Real(0.8) * dashpot * overlap * sqrt(sqrt(overlap));
  }

  /// (2/5) k d^(5/2), J.
  template <class Real>
  static Real elastic_energy(Real stiffness, Real overlap) {
    using std::sqrt;
    return Real(0.4) * stiffness * overlap * overlap * sqrt(overlap);
  }

  /// (1 - nu^2) / E, 1/Pa; of a wall too, 0 where it is rigid.
  static double compliance(const SeedMaterial& seed) { return of(seed).normal; }
  static double wall_compliance(const std::optional<ElasticMaterial>& wall) { return of(wall).normal; }
  static double compliance_of_size(double compliance, double /*size*/, double /*mass_growth*/) { return compliance; }

  /// k_t over the secant k sqrt(d): 8 G* sqrt(R* d) = 6 (G*/E*) k sqrt(d) (Mindlin 1949), times the part of it that is
  /// given, else all.
  static double tangential_ratio(const RubbingMaterials& materials, const std::optional<double>& given) {
    const Compliances a = of(materials.a), b = of(materials.b);
    return given.value_or(1) * (6 * (a.normal + b.normal) / (a.tangent + b.tangent));
  }

  /// (5 m* V^2 / (4 k))^(2/5), m.
  static double impact_overlap(double stiffness, double inverse_mass, double speed) {
    return portable_math::pow(1.25 * speed * speed / (stiffness * inverse_mass), 0.4);
  }
  /// 2.943275 d_max / V, s: 2 sqrt(pi) Gamma(7/5) / Gamma(9/10).
  static double impact_duration(double stiffness, double inverse_mass, double speed) {
    return 2.943275 * impact_overlap(stiffness, inverse_mass, speed) / speed;
  }
  static double static_overlap(double stiffness, double force) {
    return portable_math::pow(force / stiffness, 2.0 / 3);
  }
  static double slope(double stiffness, double overlap) { return 1.5 * stiffness * std::sqrt(overlap); }
  static constexpr double slope_over_secant = 1.5;
  static double damping_ratio(const SurfaceParameters& surface, double /*omega*/) { return surface.damping_ratio; }

 private:
  /// What one surface gives to a contact's compliance, 1/Pa: (1 - nu^2) / E and (2 - nu) / G; nothing where it is
  /// rigid.
  struct Compliances {
    double normal = 0, tangent = 0;
  };
  static Compliances of(double youngs_modulus, double poisson_ratio) {
    const double shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio));
    return {(1 - poisson_ratio * poisson_ratio) / youngs_modulus, (2 - poisson_ratio) / shear_modulus};
  }
  static Compliances of(const SeedMaterial& seed) { return of(seed.youngs_modulus, seed.poisson_ratio); }
  static Compliances of(const std::optional<ElasticMaterial>& wall) {
    return wall ? of(wall->youngs_modulus, wall->poisson_ratio) : Compliances{};
  }
};

template <>
struct FormulasOf<Law::hertz> {
  using Type = Hertz;
};

}  // namespace vibrosow::inline VIBROSOW_ISA
