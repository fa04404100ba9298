#pragma once

#include <cmath>

#include "contact/columns_3d.hpp"
#include "contact/data_3d.hpp"
#include "contact/force_3d.hpp"
#include "contact/history_3d.hpp"
#include "contact/pair_kernel.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// The touching ones among up to `size` pairs, as PairBlock holds them in 2D.
struct Block3d {
  static constexpr int size = pair_block_size, spare = PairBlock::spare;

  int touching;
  int entry[size + spare];  // of the list, counted from the range's first
  int grain[size + spare], partner[size + spare];
  double dx[size + spare], dy[size + spare], dz[size + spare];  // m, from the grain to its partner
  Columns3d velocity;                                           // m/s, of the grain less its partner's
  Columns3d spin, partner_spin;                                 // rad/s
  Columns3d force;                                              // N, on the grain; the opposite on its partner
  Columns3d torque, partner_torque;                             // N m, on the grain, on its partner where it differs

  /// Of eight, the longest vectors that there are.
  int whole_vectors() const { return (touching + 7) & -8; }
};

inline void fill_up(Block3d& block) {
  const int last = block.touching - 1;
  for (int k = block.touching; k < block.whole_vectors(); ++k) {
    block.entry[k] = block.entry[last], block.grain[k] = block.grain[last], block.partner[k] = block.partner[last];
    block.dx[k] = block.dx[last], block.dy[k] = block.dy[last], block.dz[k] = block.dz[last];
  }
}

/// Fetches what the contacts of a block need to know of how their balls move.
template <bool moves, bool turns>
[[gnu::noinline]] void fetch_motion(const BallMotion* motion, Block3d& block) {
  const int count = block.whole_vectors();
  if constexpr (moves)
    fetch(count, block.velocity, [&](int k, Four& row) {
      row = as_four(motion[block.grain[k]].velocity) - as_four(motion[block.partner[k]].velocity);
    });
  if constexpr (turns) {
    fetch(count, block.spin, [&](int k, Four& row) { row = as_four(motion[block.grain[k]].spin); });
    fetch(count, block.partner_spin, [&](int k, Four& row) { row = as_four(motion[block.partner[k]].spin); });
  }
}

/// Marks the pairs of a range that touch; those that do not have no history.
inline void update_touch_flags_3d(PairRange range, const unsigned char* touches, ContactHistories& histories) {
  unsigned char* touched = histories.touched.data() + range.from;
  int* place = histories.place.data() + range.from;
#pragma omp simd
  for (int k = 0; k < range.to - range.from; ++k) {
    touched[k] = touches[k];
    place[k] = touches[k] != 0 ? place[k] : ContactHistories::no_record;
  }
}

template <bool polydisperse>
[[gnu::noinline]] void find_touching(const Reach<polydisperse> reach_of, const Motion3d& at, const PairList& list,
                                     PairRange range, ContactHistories* histories, Block3d& block) {
  const int *grain = list.grain.data() + range.from, *partner = list.partner.data() + range.from;
  const int count = range.to - range.from;
  unsigned char touches[Block3d::size + Block3d::spare];
  Columns3d apart;
  fetch(count, apart, [&](int k, Four& row) { row = as_four(at.place[partner[k]]) - as_four(at.row_place[grain[k]]); });
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(grain[k]), j = static_cast<std::size_t>(partner[k]);
    const double dx = apart.x[k], dy = apart.y[k], dz = apart.z[k], reach = reach_of(i, j);
    touches[k] = dx * dx + dy * dy + dz * dz < reach * reach ? 1 : 0;
  }
  if (histories) update_touch_flags_3d(range, touches, *histories);
  block.touching = compress(touches, count, Kept<int>{places.data(), block.entry}, Kept<int>{grain, block.grain},
                            Kept<int>{partner, block.partner}, Kept<double>{apart.x, block.dx},
                            Kept<double>{apart.y, block.dy}, Kept<double>{apart.z, block.dz});
  fill_up(block);
}

/// Whether the two balls of every contact feel the same torque: equal ones, that do not resist rolling.
template <class Effects>
inline constexpr bool same_torques = !Effects::polydisperse && !Effects::rolls;

/// What the contacts of a block are worked out from, and where to.
template <class Law, class Effects>
struct PairWork3d {
  const PairProperties<Law, Effects>& properties;
  const double shortening;
  const ContactStep step;
  Block3d& block;
  BlockHistories3d& block_histories;

  /// The contact at place k of the block.
  [[gnu::always_inline]] LawMetrics operator()(int k) const {
    const std::size_t i = static_cast<std::size_t>(block.grain[k]), j = static_cast<std::size_t>(block.partner[k]);
    const PairConstants& pair = properties.pair(i, j);
    const Vector3 apart{block.dx[k], block.dy[k], block.dz[k]};
    const double distance = length(apart);
    // Coincident centres have no normal: any fixed one parts them.
    const double per_distance = 1 / distance;
    Touch3d touch;
    touch.n.x = distance > 0 ? apart.x * per_distance : 1;
    touch.n.y = distance > 0 ? apart.y * per_distance : 0;
    touch.n.z = distance > 0 ? apart.z * per_distance : 0;
    touch.overlap = pair.reach - distance;
    touch.sliding_yield = pair.approach_yield;
    [[maybe_unused]] double arm_i = 0, arm_j = 0;
    if constexpr (Effects::damping || Effects::friction) {
      const Vector3 u = block.velocity[k];
      const double kept = 1 - step.brake * pair.brake_yield, approach = dot(u, touch.n);
      touch.approach = kept * approach;
      touch.nearer = step.lag * approach;
      if constexpr (Effects::friction) {
        touch.slipping = u - approach * touch.n, touch.sliding = kept * touch.slipping;
        touch.normal_rate = (distance > 0 ? -per_distance : 0) * touch.slipping;
      }
    }
    if constexpr (Effects::rotation) {
      arm_i = properties.radius(i) - shortening * touch.overlap * pair.overlap_fraction_i;
      arm_j = arm_i;
      if constexpr (Effects::polydisperse)
        arm_j = properties.radius(j) - shortening * touch.overlap * pair.overlap_fraction_j;
      set_turning<Effects>(
          {block.spin[k], block.partner_spin[k], arm_i, arm_j, distance > 0 ? per_distance : 0.0, shortening}, pair,
          step.lag, touch);
    }
    History3d history = block_histories.template get<Effects>(static_cast<std::size_t>(k));
    const ContactForce3d force = contact_force_3d<Law, Effects>(touch, pair, properties.between(i, j), step, history);
    block_histories.template set<Effects>(static_cast<std::size_t>(k), history);
    const Vector3 on_grain = force.tangential - force.normal * touch.n;
    block.force.set(k, on_grain);
    if constexpr (Effects::rotation) {
      const Vector3 lever = cross(touch.n, force.tangential);
      block.torque.set(k, arm_i * lever + force.resistance);
      if constexpr (!same_torques<Effects>) block.partner_torque.set(k, arm_j * lever - force.resistance);
    }
    return {touch.overlap * pair.relative_per_overlap, force.slip_raised};
  }
};

template <class Law, class Effects>
[[gnu::flatten]] LawMetrics forces_of_touching(const PairWork3d<Law, Effects>& work_) {
  const PairWork3d<Law, Effects> work = work_;
  const int whole = work.block.whole_vectors(), touching = work.block.touching;
  double max_relative_overlap = 0, slip_raised = 0;
#pragma omp simd reduction(max : max_relative_overlap) reduction(+ : slip_raised)
  for (int k = 0; k < whole; ++k) {
    const LawMetrics one = work(k);
    max_relative_overlap =
        one.max_relative_overlap > max_relative_overlap ? one.max_relative_overlap : max_relative_overlap;
    if constexpr (regularised<Effects>) slip_raised += k < touching ? one.slip_raised : 0;
  }
  return {max_relative_overlap, slip_raised};
}

/// The vectors of four contacts from `from` on, the fourth number of each 0.
inline void as_rows(const Columns3d& columns, int from, Four (&rows)[4]) {
  const auto four = [from](const double* array) -> const Four& { return *reinterpret_cast<const Four*>(array + from); };
  rows[0] = four(columns.x), rows[1] = four(columns.y), rows[2] = four(columns.z), rows[3] = Four{};
  transpose(rows);
}

/// Adds the forces of a block to its grains, contact by contact in the order of the list.
template <bool rotation, bool same_torques>
[[gnu::noinline]] void add_block(const Block3d& block, PairResult3d& result) {
  Four *forces = reinterpret_cast<Four*>(result.forces), *torques = reinterpret_cast<Four*>(result.torques);
  result.foreign_count = 0;
  for (int from = 0; from < block.touching; from += 4) {
    Four force[4], own[4], other[4];
    as_rows(block.force, from, force);
    if constexpr (rotation) {
      as_rows(block.torque, from, own);
      as_rows(same_torques ? block.torque : block.partner_torque, from, other);
    }
    const int count = block.touching - from < 4 ? block.touching - from : 4;
    for (int k = 0; k < count; ++k) {
      const int i = block.grain[from + k], j = block.partner[from + k];
      forces[i] += force[k];
      if constexpr (rotation) torques[i] += own[k];
      if (j >= result.first_own) {
        forces[j] -= force[k];
        if constexpr (rotation) torques[j] += other[k];
      } else {
        ForeignForce3d& foreign = result.foreign[result.foreign_count++];
        foreign = {j, {-force[k][0], -force[k][1], -force[k][2]}, {}};
        if constexpr (rotation) foreign.torque = {other[k][0], other[k][1], other[k][2]};
      }
    }
  }
}

template <class Law, class Effects>
[[gnu::flatten]] void pair_forces_3d(const GrainSurfaces& grains, const Motion3d& at, const PairList& list,
                                     PairRange range, const ContactParameters& parameters, const ContactStep& step,
                                     ContactHistories& histories, PairResult3d& result) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  const bool leaves_trace = keeps_history<Effects> && step.commit != 0;
  Block3d block;
  find_touching(properties.reach(), at, list, range, leaves_trace ? &histories : nullptr, block);
  if constexpr (keeps_history<Effects>) await_records<RecordOf<Effects>>(histories, range.from, block.touching);
  fetch_motion<Effects::damping || Effects::friction, Effects::rotation>(at.motion, block);
  BlockHistories3d block_histories;
  if constexpr (keeps_history<Effects>)
    load_block<RecordOf<Effects>>(histories, block.entry, range.from, block.whole_vectors(), block_histories);
  result.metrics =
      forces_of_touching<Law, Effects>({properties, parameters.arm_shortening, step, block, block_histories});
  if (leaves_trace)
    store_block<RecordOf<Effects>>(block_histories, block.entry, range.from, block.touching, PlacesFrom{range.from},
                                   histories);
  add_block<Effects::rotation, same_torques<Effects>>(block, result);
  result.contacts = block.touching;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
