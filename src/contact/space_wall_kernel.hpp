#pragma once

#include <cmath>

#include "contact/space_data.hpp"
#include "contact/space_force.hpp"
#include "contact/space_history.hpp"
#include "contact/wall_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Forces of the contacts [from, from + count), at most pair_block_size of them.
template <class Law, class Effects>
[[gnu::flatten]] LawFigures forces_of_walls(const WallProperties<Law, Effects>& properties, const SpaceMotion& at,
                                            const ContactParameters& parameters, const HistoryAdvance& advance_,
                                            int from, int count, SpaceWallContacts& contacts,
                                            SpaceBlockHistories& block_histories) {
  const double shortening = parameters.arm_shortening;
  const HistoryAdvance advance = advance_;
  const SpaceMotion m = at;
  const int* grain = contacts.grain.data() + from;
  const double *nx = contacts.normal.x.data() + from, *ny = contacts.normal.y.data() + from,
               *nz = contacts.normal.z.data() + from, *distances = contacts.distance.data() + from;
  const double *wall_x = contacts.wall_velocity.x.data() + from, *wall_y = contacts.wall_velocity.y.data() + from,
               *wall_z = contacts.wall_velocity.z.data() + from;
  const double *spin_x = contacts.wall_spin.x.data() + from, *spin_y = contacts.wall_spin.y.data() + from,
               *spin_z = contacts.wall_spin.z.data() + from;
  double *fx = contacts.force.x.data() + from, *fy = contacts.force.y.data() + from,
         *fz = contacts.force.z.data() + from;
  double *tx = contacts.torque.x.data() + from, *ty = contacts.torque.y.data() + from,
         *tz = contacts.torque.z.data() + from;
  double max_relative_overlap = 0, slip_raised = 0;
#pragma omp simd reduction(max : max_relative_overlap) reduction(+ : slip_raised)
  for (int k = 0; k < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(grain[k]);
    const PairConstants& pair = properties.pair(i);
    SpaceTouch touch;
    touch.n = {nx[k], ny[k], nz[k]};
    touch.overlap = properties.radius(i) - distances[k];
    const double relative_overlap = touch.overlap * pair.relative_per_overlap;
    max_relative_overlap = relative_overlap > max_relative_overlap ? relative_overlap : max_relative_overlap;
    [[maybe_unused]] double arm = 0;
    if constexpr (Effects::damping || Effects::friction) {
      const Vector3 u{m.vx[i] - wall_x[k], m.vy[i] - wall_y[k], m.vz[i] - wall_z[k]};
      touch.approach = dot(u, touch.n);
      if constexpr (Effects::friction) touch.sliding = u - touch.approach * touch.n;
    }
    if constexpr (Effects::rotation) {
      arm = properties.radius(i) - shortening * touch.overlap * pair.overlap_fraction_i;
      set_turning<Effects>({m.omega_x[i], m.omega_y[i], m.omega_z[i]}, {spin_x[k], spin_y[k], spin_z[k]}, arm, 0,
                           touch);
    }
    SpaceHistory history = block_histories.template get<Effects>(static_cast<std::size_t>(k));
    const SpaceContactForce force =
        space_contact_force<Law, Effects>(touch, pair, properties.surface(i), advance, history);
    block_histories.template set<Effects>(static_cast<std::size_t>(k), history);
    if constexpr (regularised<Effects>) slip_raised += force.slip_raised;
    const Vector3 on_grain = force.tangential - force.normal * touch.n;
    fx[k] = on_grain.x, fy[k] = on_grain.y, fz[k] = on_grain.z;
    if constexpr (Effects::rotation) {
      const Vector3 torque = arm * cross(touch.n, force.tangential) + force.resistance;
      tx[k] = torque.x, ty[k] = torque.y, tz[k] = torque.z;
    }
  }
  return {max_relative_overlap, slip_raised};
}

template <class Law, class Effects>
[[gnu::flatten]] LawFigures space_wall_forces(const GrainSurfaces& grains, const SpaceMotion& at,
                                              const ContactParameters& parameters, const HistoryAdvance& advance,
                                              ContactHistories& histories, SpaceWallContacts& contacts) {
  const WallProperties<Law, Effects> properties(grains, parameters);
  SpaceBlockHistories block_histories;
  LawFigures figures;
  for (int from = 0; from < contacts.count; from += pair_block_size) {
    const int count = contacts.count - from < pair_block_size ? contacts.count - from : pair_block_size;
    const int* candidate = contacts.candidate.data() + from;
    load_block<Effects>(histories, candidate, 0, count, block_histories);
    const LawFigures here =
        forces_of_walls<Law, Effects>(properties, at, parameters, advance, from, count, contacts, block_histories);
    figures.max_relative_overlap = std::max(figures.max_relative_overlap, here.max_relative_overlap);
    figures.slip_raised += here.slip_raised;
    if (keeps_history<Effects> && advance.commit > 0)
      store_block<Effects>(block_histories, candidate, 0, count, histories);
  }
  return figures;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
