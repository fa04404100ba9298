#pragma once

#include <cmath>

#include "contact/columns_3d.hpp"
#include "contact/data_3d.hpp"
#include "contact/force_3d.hpp"
#include "contact/history_3d.hpp"
#include "contact/wall_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Vectors of contacts after a first one, to read and to write.
struct ColumnsFrom {
  ColumnsFrom(const VectorColumns& columns, int from)
      : x(columns.x.data() + from), y(columns.y.data() + from), z(columns.z.data() + from) {}
  const double *x, *y, *z;
  [[gnu::always_inline]] Vector3 operator[](int k) const { return {x[k], y[k], z[k]}; }
};
struct ColumnsTo {
  ColumnsTo(VectorColumns& columns, int from)
      : x(columns.x.data() + from), y(columns.y.data() + from), z(columns.z.data() + from) {}
  double *x, *y, *z;
  [[gnu::always_inline]] void set(int k, const Vector3& a) const { x[k] = a.x, y[k] = a.y, z[k] = a.z; }
};

/// What contacts with walls are worked out from, and where to.
template <class Law, class Effects>
struct WallWork3d {
  const WallProperties<Law, Effects>& properties;
  const double shortening;
  const ContactStep step;
  const int* grain;
  const double* distances;
  const Columns3d &velocity, &spin;
  const ColumnsFrom normal, wall_velocity, mean_wall_velocity, wall_spin;
  const ColumnsTo forces, torques;
  BlockHistories3d& block_histories;

  /// The contact at place k of the block.
  [[gnu::always_inline]] LawMetrics operator()(int k) const {
    const std::size_t i = static_cast<std::size_t>(grain[k]);
    const PairConstants& pair = properties.pair(i);
    Touch3d touch;
    touch.n = normal[k];
    touch.overlap = properties.radius(i) - distances[k];
    touch.sliding_yield = pair.approach_yield;
    [[maybe_unused]] double arm = 0;
    if constexpr (Effects::damping || Effects::friction) {
      const double kept = 1 - step.brake * pair.brake_yield;
      const Vector3 v = velocity[k], u = kept * v + Vector3{step.fall_x, step.fall_y, 0} - wall_velocity[k];
      touch.approach = dot(u, touch.n);
      if constexpr (Effects::friction) touch.sliding = u - touch.approach * touch.n;
      if constexpr (keeps_history<Effects>) {
        const Vector3 on_mean = v - mean_wall_velocity[k];
        const double approach = dot(on_mean, touch.n);
        touch.slipping = on_mean - approach * touch.n, touch.nearer = step.lag * approach;
      }
    }
    if constexpr (Effects::rotation) {
      arm = properties.radius(i) - shortening * touch.overlap * pair.overlap_fraction_i;
      set_turning<Effects>({spin[k], wall_spin[k], arm, 0, 0, shortening}, pair, step.lag, touch);
    }
    History3d history = block_histories.template get<Effects>(static_cast<std::size_t>(k));
    const ContactForce3d force = contact_force_3d<Law, Effects>(touch, pair, properties.surface(i), step, history);
    block_histories.template set<Effects>(static_cast<std::size_t>(k), history);
    forces.set(k, force.tangential - force.normal * touch.n);
    if constexpr (Effects::rotation) torques.set(k, arm * cross(touch.n, force.tangential) + force.resistance);
    return {touch.overlap * pair.relative_per_overlap, force.slip_raised};
  }
};

template <class Law, class Effects>
[[gnu::flatten]] LawMetrics forces_of_walls(const WallWork3d<Law, Effects>& work_, int count) {
  const WallWork3d<Law, Effects> work = work_;
  double max_relative_overlap = 0, slip_raised = 0;
#pragma omp simd reduction(max : max_relative_overlap) reduction(+ : slip_raised)
  for (int k = 0; k < count; ++k) {
    const LawMetrics one = work(k);
    max_relative_overlap =
        one.max_relative_overlap > max_relative_overlap ? one.max_relative_overlap : max_relative_overlap;
    if constexpr (regularised<Effects>) slip_raised += one.slip_raised;
  }
  return {max_relative_overlap, slip_raised};
}

template <class Law, class Effects>
[[gnu::flatten]] LawMetrics wall_forces_3d(const GrainSurfaces& grains, const Motion3d& at,
                                           const ContactParameters& parameters, const ContactStep& step,
                                           ContactHistories& histories, WallContacts3d& contacts) {
  const WallProperties<Law, Effects> properties(grains, parameters);
  BlockHistories3d block_histories;
  Columns3d velocity, spin;
  LawMetrics metrics;
  for (int from = 0; from < contacts.count; from += pair_block_size) {
    const int count = contacts.count - from < pair_block_size ? contacts.count - from : pair_block_size;
    const int *candidate = contacts.candidate.data() + from, *grain = contacts.grain.data() + from;
    if constexpr (Effects::damping || Effects::friction)
      fetch(count, velocity, [&](int k, Four& row) { row = as_four(at.motion[grain[k]].velocity); });
    if constexpr (Effects::rotation)
      fetch(count, spin, [&](int k, Four& row) { row = as_four(at.motion[grain[k]].spin); });
    if constexpr (keeps_history<Effects>)
      load_block<RecordOf<Effects>>(histories, candidate, 0, count, block_histories);
    const LawMetrics here = forces_of_walls<Law, Effects>({properties,
                                                           parameters.arm_shortening,
                                                           step,
                                                           grain,
                                                           contacts.distance.data() + from,
                                                           velocity,
                                                           spin,
                                                           {contacts.normal, from},
                                                           {contacts.wall_velocity, from},
                                                           {contacts.mean_wall_velocity, from},
                                                           {contacts.wall_spin, from},
                                                           {contacts.force, from},
                                                           {contacts.torque, from},
                                                           block_histories},
                                                          count);
    metrics.max_relative_overlap = std::max(metrics.max_relative_overlap, here.max_relative_overlap);
    metrics.slip_raised += here.slip_raised;
    if (keeps_history<Effects> && step.commit != 0)
      store_block<RecordOf<Effects>>(block_histories, candidate, 0, count, PlacesOfEntries{candidate}, histories);
  }
  return metrics;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
