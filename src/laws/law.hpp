#pragma once

#include <concepts>
#include <optional>
#include <string_view>

#include "compute/instruction_set.hpp"
#include "laws/materials.hpp"
#include "laws/surface_parameters.hpp"
#include "scene/contact_choices.hpp"

namespace vibrosow {

/// Which keys of a seeder say how stiff a seed is: shell_compression, or youngs_modulus and poisson_ratio.
enum class LawMaterial { shell, elastic };

/// What gives the damping: a restitution for each surface, or one damping_rate.
enum class LawDamping { restitution, rate };

/// Everything the program knows of a law, wherever it does not run in the inner loops. Arguments in SI.
struct LawTraits {
  std::string_view name;         // what a user writes
  std::string_view description;  // for people
  LawMaterial material;
  LawDamping damping;
  bool duration_depends_on_speed;  // of an impact

  double (*compliance)(const SeedMaterial&);
  double (*wall_compliance)(const std::optional<ElasticMaterial>&);
  double (*compliance_of_size)(double compliance, double size, double mass_growth);
  double (*tangential_ratio)(const RubbingMaterials&, const std::optional<double>& given);

  double (*stiffness)(double compliance_i, double compliance_j, double curvature_i, double curvature_j);
  double (*impact_overlap)(double stiffness, double inverse_mass, double speed);
  double (*impact_duration)(double stiffness, double inverse_mass, double speed);
  double (*static_overlap)(double stiffness, double force);
  double (*slope)(double stiffness, double overlap);
  double slope_over_secant;
  double (*damping_ratio)(const SurfaceParameters&, double omega);

  /// The key that makes contacts stiffer, and which way: "contact.shell_compression", "smaller".
  std::string_view stiffness_key() const {
    return material == LawMaterial::shell ? "contact.shell_compression" : "contact.youngs_modulus";
  }
  std::string_view stiffer_value() const { return material == LawMaterial::shell ? "smaller" : "larger"; }
};

const LawTraits& traits_of(Law law);

}  // namespace vibrosow

namespace vibrosow::inline VIBROSOW_ISA {

/// The formulas of a law, which its header names.
template <Law law>
struct FormulasOf;

/// From a law's formulas. What a law does not say does not compile.
template <class Formulas>
constexpr LawTraits traits_from() {
  return {.name = Formulas::name,
          .description = Formulas::description,
          .material = Formulas::material,
          .damping = Formulas::damping,
          .duration_depends_on_speed = Formulas::duration_depends_on_speed,
          .compliance = Formulas::compliance,
          .wall_compliance = Formulas::wall_compliance,
          .compliance_of_size = Formulas::compliance_of_size,
          .tangential_ratio = Formulas::tangential_ratio,
          .stiffness = Formulas::template stiffness<double>,
          .impact_overlap = Formulas::impact_overlap,
          .impact_duration = Formulas::impact_duration,
          .static_overlap = Formulas::static_overlap,
          .slope = Formulas::slope,
          .slope_over_secant = Formulas::slope_over_secant,
          .damping_ratio = Formulas::damping_ratio};
}

}  // namespace vibrosow::inline VIBROSOW_ISA
