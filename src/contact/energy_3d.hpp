#pragma once

#include "contact/data_3d.hpp"
#include "contact/history_3d.hpp"
#include "contact/pair_properties.hpp"
#include "contact/touching_pairs.hpp"
#include "contact/wall_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Energy of the springs of one contact in 3D, J.
template <class Law, class Effects>
inline double contact_energy_3d(double overlap, const PairConstants& pair, const SurfaceParameters& surface,
                                const History3d& history) {
  double energy = Law::elastic_energy(pair.stiffness, overlap);
  [[maybe_unused]] const double secant = Law::secant(pair.stiffness, overlap);
  if constexpr (Effects::cohesion) energy -= surface.cohesion * overlap;
  if constexpr (Effects::spring) energy += 0.5 * surface.tangential_ratio * secant * dot(history.slip, history.slip);
  if constexpr (Effects::rolling == Rolling::spring) {
    const double rolls = surface.rolling_friction * pair.rolling_radius;
    const double twists = surface.twisting_friction * pair.rolling_radius;
    energy += 0.5 * 2.25 * secant *
              (rolls * rolls * dot(history.roll, history.roll) + twists * twists * history.twist * history.twist);
  }
  return energy;
}

template <class Law, class Effects>
double pair_energy_3d(const GrainSurfaces& grains, const Motion3d& at, const PairList& list,
                      const ContactParameters& parameters, const ContactHistories& histories) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  double energy = 0;
  for_each_touching(
      list,
      [&](std::size_t i, std::size_t j) {
        const GrainVector &from = at.row_place[i], &to = at.place[j];
        const Vector3 apart{to.x - from.x, to.y - from.y, to.z - from.z};
        return PairReach{properties.reach()(i, j), dot(apart, apart)};
      },
      [&](std::size_t k, std::size_t i, std::size_t j, double overlap) {
        energy += contact_energy_3d<Law, Effects>(overlap, properties.pair(i, j), properties.between(i, j),
                                                  load_record<Effects>(histories, k));
      });
  return energy;
}

template <class Law, class Effects>
double wall_energy_3d(const GrainSurfaces& grains, const WallContacts3d& contacts, const ContactParameters& parameters,
                      const ContactHistories& histories) {
  const WallProperties<Law, Effects> properties(grains, parameters);
  double energy = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contacts.count); ++k) {
    const std::size_t i = static_cast<std::size_t>(contacts.grain[k]);
    const History3d history = load_record<Effects>(histories, static_cast<std::size_t>(contacts.candidate[k]));
    energy += contact_energy_3d<Law, Effects>(properties.radius(i) - contacts.distance[k], properties.pair(i),
                                              properties.surface(i), history);
  }
  return energy;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
