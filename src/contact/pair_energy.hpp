#pragma once

#include "contact/pair_properties.hpp"
#include "contact/touching_pairs.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <class Law, class Effects>
double pair_energy(const GrainSurfaces& grains, const Motion& at, const PairList& list,
                   const ContactParameters& parameters, const ContactHistories& histories) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  double energy = 0;
  for_each_touching(
      list,
      [&](std::size_t i, std::size_t j) {
        const double dx = at.x[j] - at.row_x[i], dy = at.y[j] - at.y[i];
        return PairReach{properties.reach()(i, j), dx * dx + dy * dy};
      },
      [&](std::size_t k, std::size_t i, std::size_t j, double overlap) {
        energy += contact_energy<Law, Effects>(overlap, properties.pair(i, j), properties.between(i, j),
                                               stored_slip<Effects>(histories, k), stored_roll<Effects>(histories, k));
      });
  return energy;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
