#pragma once

#include <cmath>

#include "contact/contact_force.hpp"
#include "contact/pair_block.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Of two grains, or of a grain and a wall (radius 0 stands for its place, compliance its own, the rest 0).
template <class Law, class Effects>
inline PairConstants pair_constants(const GrainSurface& a, const GrainSurface& b, const SurfaceParameters& surface,
                                    const ContactParameters& parameters) {
  PairConstants p;
  p.reach = a.radius + b.radius;
  p.stiffness = Law::stiffness(a.compliance, b.compliance, a.curvature, b.curvature);
  if constexpr (Effects::damping) p.dashpot = Law::dashpot(surface, p.stiffness, a.inverse_mass, b.inverse_mass);
  const double compliance = a.compliance + b.compliance;
  p.overlap_fraction_i = a.compliance / compliance;
  p.overlap_fraction_j = b.compliance / compliance;
  const double at_i = p.overlap_fraction_i * a.curvature, at_j = p.overlap_fraction_j * b.curvature;
  p.relative_per_overlap = at_i > at_j ? at_i : at_j;
  p.approach_yield = a.inverse_mass + b.inverse_mass + (a.lever_yield + b.lever_yield);
  p.brake_yield = b.inverse_mass > 0 ? 0.5 * (a.inverse_mass + b.inverse_mass) : a.inverse_mass;
  if constexpr (Effects::rotation) p.turning_yield_i = a.inverse_inertia, p.turning_yield_j = b.inverse_inertia;
  if constexpr (Effects::friction && !Effects::spring)
    p.steepest_sliding = parameters.steepest_sliding / (a.inverse_mass + b.inverse_mass);
  if constexpr (Effects::rolls) p.rolling_radius = 1 / (a.curvature + b.curvature);
  if constexpr (Effects::rolling == Rolling::constant_torque)
    p.steepest_rolling = parameters.steepest_rolling / (p.rolling_radius * (a.inverse_inertia + b.inverse_inertia));
  if constexpr (Effects::rolling == Rolling::spring) {
    // 1 / (I + m r^2) of each, about the contact; a wall has none, a grain kept from turning neither
    const auto yield = [](const GrainSurface& g) {
      return g.inverse_inertia > 0
                 ? g.inverse_inertia * g.inverse_mass / (g.inverse_mass + g.inverse_inertia * g.radius * g.radius)
                 : 0.0;
    };
    const double both = yield(a) + yield(b);
    p.rolling_inertia = both > 0 ? 1 / both : 0;
    const double about_normal = a.inverse_inertia + b.inverse_inertia;
    p.twisting_inertia = about_normal > 0 ? 1 / about_normal : 0;
  }
  return p;
}

/// The distance of their centres, m, below which two grains touch.
template <bool polydisperse>
struct Reach {
  const double* radius;
  double equal;

  double operator()(std::size_t i, std::size_t j) const {
    if constexpr (polydisperse) return radius[i] + radius[j];
    return equal;
  }
};

/// Properties of two grains as the kernel sees them: constants for equal grains, worked out pair by pair for
/// polydisperse ones from the same expressions, so that both give the same bits for equal grains.
template <class Law, class Effects>
class PairProperties {
 public:
  PairProperties(const GrainSurfaces& grains, const ContactParameters& parameters)
      : grains_(grains), parameters_(parameters) {
    if constexpr (!Effects::polydisperse) {
      equal_surface_ = parameters.pair(0, 0);
      equal_ = pair_constants<Law, Effects>(surface(0), surface(0), equal_surface_, parameters);
    }
  }

  Reach<Effects::polydisperse> reach() const {
    if constexpr (Effects::polydisperse) return {grains_.radius, 0};
    return {grains_.radius, equal_.reach};
  }
  double radius(std::size_t i) const {
    if constexpr (Effects::polydisperse) return grains_.radius[i];
    return 0.5 * equal_.reach;
  }
  const SurfaceParameters& between(std::size_t i, std::size_t j) const {
    if constexpr (Effects::polydisperse) return parameters_.pair(grains_.lot[i], grains_.lot[j]);
    return equal_surface_;
  }
  /// A value for polydisperse grains, a reference for equal ones.
  decltype(auto) pair(std::size_t i, std::size_t j) const {
    if constexpr (Effects::polydisperse)
      return pair_constants<Law, Effects>(surface(i), surface(j), between(i, j), parameters_);
    else
      return (equal_);
  }

 private:
  GrainSurface surface(std::size_t i) const {
    if constexpr (Effects::polydisperse)
      return {grains_.radius[i],          grains_.compliance[i], grains_.inverse_mass[i],
              grains_.inverse_inertia[i], grains_.curvature[i],  grains_.lever_yield[i]};
    return grains_.equal;
  }

  const GrainSurfaces grains_;
  const ContactParameters& parameters_;
  PairConstants equal_;
  SurfaceParameters equal_surface_;  // a copy: for all the compiler knows, storing a force could change the original
};

}  // namespace vibrosow::inline VIBROSOW_ISA
