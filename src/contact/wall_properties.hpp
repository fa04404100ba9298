#pragma once

#include "contact/pair_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Properties of a grain and the walls, seen as a grain of infinite radius and mass: the law is the pair's.
template <class Law, class Effects>
class WallProperties {
 public:
  WallProperties(const GrainSurfaces& grains, const ContactParameters& parameters)
      : grains_(grains), parameters_(parameters) {
    if constexpr (!Effects::polydisperse) {
      equal_surface_ = parameters.walls.front();
      equal_ = constants(grains.equal, equal_surface_);
    }
  }

  double radius(std::size_t i) const {
    if constexpr (Effects::polydisperse) return grains_.radius[i];
    return grains_.equal.radius;
  }
  const SurfaceParameters& surface(std::size_t i) const {
    if constexpr (Effects::polydisperse) return parameters_.wall(grains_.lot[i]);
    return equal_surface_;
  }
  /// A value for polydisperse grains, a reference for equal ones.
  decltype(auto) pair(std::size_t i) const {
    if constexpr (Effects::polydisperse)
      return constants({grains_.radius[i], grains_.compliance[i], grains_.inverse_mass[i], grains_.inverse_inertia[i],
                        grains_.curvature[i], grains_.lever_yield[i]},
                       surface(i));
    else
      return (equal_);
  }

 private:
  PairConstants constants(const GrainSurface& grain, const SurfaceParameters& surface) const {
    return pair_constants<Law, Effects>(grain, {0, parameters_.wall_compliance, 0, 0, 0, 0}, surface, parameters_);
  }

  const GrainSurfaces grains_;
  const ContactParameters& parameters_;
  PairConstants equal_;
  SurfaceParameters equal_surface_;  // a copy, as that of pairs
};

}  // namespace vibrosow::inline VIBROSOW_ISA
