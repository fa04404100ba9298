#pragma once

#include <cmath>

#include "contact/pair_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <class Law, class Effects>
double pair_energy(const GrainSurfaces& grains, const Motion& at, const PairList& list,
                   const ContactParameters& parameters, const ContactHistories& histories) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  double energy = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(list.grain[k]), j = static_cast<std::size_t>(list.partner[k]);
    const double dx = at.x[j] - at.row_x[i], dy = at.y[j] - at.y[i];
    const double reach = properties.reach(i, j), distance2 = dx * dx + dy * dy;
    if (distance2 >= reach * reach) continue;  // most: then the root is not less than reach, by IEEE's rounding
    const double overlap = reach - std::sqrt(distance2);
    if (overlap > 0)
      energy += contact_energy<Law, Effects>(overlap, properties.pair(i, j), properties.between(i, j),
                                             load_history<Effects>(histories, k));
  }
  return energy;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
