#pragma once

#include <cmath>

#include "contact/wall_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <class Law, class Effects>
double wall_energy(const GrainSurfaces& grains, const WallContacts& contacts, const ContactParameters& parameters,
                   const ContactHistories& histories) {
  const WallProperties<Law, Effects> properties(grains, parameters);
  double energy = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contacts.count); ++k) {
    const std::size_t i = static_cast<std::size_t>(contacts.grain[k]);
    const double overlap = properties.radius(i) - std::sqrt(contacts.distance2[k]);
    const std::size_t c = static_cast<std::size_t>(contacts.candidate[k]);
    energy += contact_energy<Law, Effects>(overlap, properties.pair(i), properties.surface(i),
                                           stored_slip<Effects>(histories, c), stored_roll<Effects>(histories, c));
  }
  return energy;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
