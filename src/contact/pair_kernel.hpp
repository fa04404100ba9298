#pragma once

#include <array>
#include <cmath>

#include "compute/compress.hpp"
#include "compute/four.hpp"
#include "contact/pair_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// The touching ones among up to `size` pairs, in the order of the list: of each array the first `touching` places, and
/// more for whole vectors.
struct PairBlock {
  static constexpr int size = pair_block_size, spare = 16;

  int touching;
  int entry[size + spare];  // of the list, counted from the range's first
  int grain[size + spare], partner[size + spare];
  double dx[size + spare], dy[size + spare];  // m, from the grain to its partner
  // N, on the partner; the opposite on the grain
  alignas(64) double fx[pair_block_room], fy[pair_block_room];
  // N m, with its sign changed on the grain
  alignas(64) double torque[pair_block_room], partner_torque[pair_block_room];
  alignas(64) double relative_overlap[pair_block_room];

  int whole_vectors() const { return (touching + spare - 1) & -spare; }
};

/// 0, 1, 2, ..
inline constexpr auto places = [] {
  std::array<int, PairBlock::size> list{};
  for (int k = 0; k < PairBlock::size; ++k) list[static_cast<std::size_t>(k)] = k;
  return list;
}();

/// Marks the pairs of a range that touch, and calls `forget(entry)` for those that touched before and do not now.
template <class Forget>
void part(PairRange range, const unsigned char* touches, ContactHistories& histories, Forget forget) {
  const int count = range.to - range.from;
  unsigned char* touched = histories.touched.data() + range.from;
  unsigned char parted[PairBlock::size + PairBlock::spare];
  int place[PairBlock::size + PairBlock::spare];
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    parted[k] = static_cast<unsigned char>(touched[k] & (touches[k] ^ 1));
    touched[k] = touches[k];
  }
  const int forgotten = compress(parted, count, Kept<int>{places.data(), place});
  for (int k = 0; k < forgotten; ++k) {
    const int entry = range.from + place[k];
    forget(static_cast<std::size_t>(entry));
  }
}

/// Repeats the last contact up to a whole number of vectors: what is worked out for it there counts for nothing.
inline void fill_up(PairBlock& block) {
  const int last = block.touching - 1;
  for (int k = block.touching; k < block.whole_vectors(); ++k) {
    block.entry[k] = block.entry[last], block.grain[k] = block.grain[last], block.partner[k] = block.partner[last];
    block.dx[k] = block.dx[last], block.dy[k] = block.dy[last];
  }
}

// What goes over a whole block without the law is not inlined: compiled once, not for each choice of effects.

/// Finds the pairs of a range whose grains touch. Those that do not lose their history, where there are `histories`.
template <bool polydisperse>
[[gnu::noinline]] void find_touching(const Reach<polydisperse> reach_of, const Motion& at, const PairList& list,
                                     PairRange range, ContactHistories* histories, PairBlock& block) {
  const double *x = at.x, *row_x = at.row_x, *y = at.y;
  const int *grain = list.grain.data() + range.from, *partner = list.partner.data() + range.from;
  const int count = range.to - range.from;
  unsigned char touches[PairBlock::size + PairBlock::spare];
  double all_dx[PairBlock::size], all_dy[PairBlock::size];
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(grain[k]), j = static_cast<std::size_t>(partner[k]);
    const double dx = x[j] - row_x[i], dy = y[j] - y[i], reach = reach_of(i, j);
    all_dx[k] = dx, all_dy[k] = dy;
    touches[k] = dx * dx + dy * dy < reach * reach ? 1 : 0;
  }
  if (histories) part(range, touches, *histories, [histories](std::size_t entry) { histories->forget(entry); });
  block.touching =
      compress(touches, count, Kept<int>{places.data(), block.entry}, Kept<int>{grain, block.grain},
               Kept<int>{partner, block.partner}, Kept<double>{all_dx, block.dx}, Kept<double>{all_dy, block.dy});
  fill_up(block);
}

/// Histories of the contacts of a block.
struct BlockHistories {
  double slip[pair_block_room], roll[pair_block_room];
};

/// Stores the histories of the first `count` contacts of a block, at their entries of the list after `first`.
template <class Effects>
void store_block(const BlockHistories& block_histories, const int* entry, int first, int count,
                 ContactHistories& histories) {
  const auto keep = [entry, first, count](const double* of_block, std::vector<double>& of_list) {
    double* of_list_at = of_list.data() + first;
    for (int k = 0; k < count; ++k) of_list_at[entry[k]] = of_block[k];
  };
  if constexpr (Effects::spring) keep(block_histories.slip, histories.slip);
  if constexpr (Effects::rolling == Rolling::spring) keep(block_histories.roll, histories.roll);
}

/// In a loop of its own: with it, clang leaves the loop over the contacts scalar.
inline double max_relative_overlap(const PairBlock& block) {
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int k = 0; k < block.whole_vectors(); ++k)
    most = block.relative_overlap[k] > most ? block.relative_overlap[k] : most;
  return most;
}

template <class Law, class Effects>
[[gnu::flatten]] LawMetrics forces_of_touching(const PairProperties<Law, Effects>& properties, const Motion& at,
                                               int first_entry, const ContactParameters& parameters,
                                               const ContactStep& step_, const ContactHistories& histories,
                                               PairBlock& block, BlockHistories& block_histories) {
  const double shortening = parameters.arm_shortening;
  const ContactStep step = step_;
  const double *vx = at.vx, *vy = at.vy, *omega = at.omega;
  const int whole = block.whole_vectors();
  const int touching = block.touching;
  double slip_raised = 0;
#pragma omp simd reduction(+ : slip_raised)
  for (int k = 0; k < whole; ++k) {
    const int entry = first_entry + block.entry[k];
    const std::size_t e = static_cast<std::size_t>(entry);
    const std::size_t i = static_cast<std::size_t>(block.grain[k]), j = static_cast<std::size_t>(block.partner[k]);
    const PairConstants& pair = properties.pair(i, j);
    const double dx = block.dx[k], dy = block.dy[k];
    const double distance = std::sqrt(dx * dx + dy * dy);
    // Coincident centres have no normal: any fixed one parts them.
    const double per_distance = 1 / distance;
    const double nx = distance > 0 ? dx * per_distance : 1, ny = distance > 0 ? dy * per_distance : 0;
    const double overlap = pair.reach - distance;
    block.relative_overlap[k] = overlap * pair.relative_per_overlap;

    Touch touch{overlap, 0, 0, 0, 0, pair.approach_yield};
    [[maybe_unused]] double arm_i = 0, arm_j = 0;
    if constexpr (Effects::damping || Effects::friction) {
      const double ux = vx[i] - vx[j], uy = vy[i] - vy[j];
      const double kept = 1 - step.brake * pair.brake_yield;
      const double approach = ux * nx + uy * ny, nearer = step.lag * approach;
      if constexpr (Effects::damping) touch.approach = kept * approach;
      if constexpr (Effects::friction) touch.sliding = uy * nx - ux * ny;
      // In the middle of the step the two were further apart by `nearer`: the normal has turned since.
      if constexpr (Effects::spring) touch.slipping = touch.sliding * (1 - (distance > 0 ? nearer * per_distance : 0));
      touch.sliding *= kept;
      if constexpr (Effects::rotation) {
        arm_i = properties.radius(i) - shortening * overlap * pair.overlap_fraction_i;
        arm_j = properties.radius(j) - shortening * overlap * pair.overlap_fraction_j;
        touch.sliding += arm_i * omega[i] + arm_j * omega[j];
        if constexpr (Effects::spring) {
          const double longer = shortening * nearer;
          touch.slipping += (arm_i + longer * pair.overlap_fraction_i) * omega[i] +
                            (arm_j + longer * pair.overlap_fraction_j) * omega[j];
        }
        touch.sliding_yield += arm_i * arm_i * pair.turning_yield_i + arm_j * arm_j * pair.turning_yield_j;
      }
      if constexpr (Effects::rolls) touch.turning = omega[i] - omega[j];
    }
    double slip = stored_slip<Effects>(histories, e), roll = stored_roll<Effects>(histories, e);
    const ContactForce force = contact_force<Law, Effects>(touch, pair, properties.between(i, j), step, slip, roll);
    if constexpr (Effects::spring) block_histories.slip[k] = slip;
    if constexpr (Effects::rolling == Rolling::spring) block_histories.roll[k] = roll;
    // On the grain: -F_n n - F_t t with t = (-n_y, n_x).
    double fx = force.normal * nx, fy = force.normal * ny;
    if constexpr (Effects::friction) fx -= force.tangential * ny, fy += force.tangential * nx;
    double torque = 0, partner_torque = 0;
    if constexpr (Effects::rotation) {
      torque = force.rolling - arm_i * force.tangential;
      partner_torque = -force.rolling - arm_j * force.tangential;
    }
    if constexpr (regularised<Effects>) slip_raised += k < touching ? force.slip_raised : 0;
    block.fx[k] = fx, block.fy[k] = fy, block.torque[k] = -torque, block.partner_torque[k] = partner_torque;
  }
  return {max_relative_overlap(block), slip_raised};
}

/// Adds the forces of a block to its grains, four contacts at a time. The spare number of a sum takes up whichever
/// torque is not its own.
[[gnu::noinline]] inline void add_block(const PairBlock& block, PairResult& result) {
  Four* sums = reinterpret_cast<Four*>(result.forces);
  result.foreign_count = 0;
  const auto add = [&](int k, const Four& force) {
    sums[block.grain[k]] -= force;
    const int j = block.partner[k];
    if (j >= result.first_own)
      sums[j] += __builtin_shufflevector(force, force, 0, 1, 3, 2);
    else
      result.foreign[result.foreign_count++] = {j, force[0], force[1], force[3]};
  };
  const auto four = [](const double* array, int k) -> const Four& { return *reinterpret_cast<const Four*>(array + k); };
  for (int k = 0; k < block.touching; k += 4) {
    const Four fx = four(block.fx, k), fy = four(block.fy, k);
    const Four own = four(block.torque, k), other = four(block.partner_torque, k);
    const Four force02 = __builtin_shufflevector(fx, fy, 0, 4, 2, 6),
               force13 = __builtin_shufflevector(fx, fy, 1, 5, 3, 7);
    const Four turn02 = __builtin_shufflevector(own, other, 0, 4, 2, 6);
    const Four turn13 = __builtin_shufflevector(own, other, 1, 5, 3, 7);
    add(k, __builtin_shufflevector(force02, turn02, 0, 1, 4, 5));
    if (k + 1 < block.touching) add(k + 1, __builtin_shufflevector(force13, turn13, 0, 1, 4, 5));
    if (k + 2 < block.touching) add(k + 2, __builtin_shufflevector(force02, turn02, 2, 3, 6, 7));
    if (k + 3 < block.touching) add(k + 3, __builtin_shufflevector(force13, turn13, 2, 3, 6, 7));
  }
}

template <class Law, class Effects>
[[gnu::flatten]] void pair_forces(const GrainSurfaces& grains, const Motion& at, const PairList& list, PairRange range,
                                  const ContactParameters& parameters, const ContactStep& step,
                                  ContactHistories& histories, PairResult& result) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  const bool leaves_trace = keeps_history<Effects> && step.commit != 0;
  PairBlock block;
  find_touching(properties.reach(), at, list, range, leaves_trace ? &histories : nullptr, block);
  BlockHistories block_histories;
  result.metrics =
      forces_of_touching<Law, Effects>(properties, at, range.from, parameters, step, histories, block, block_histories);
  if (leaves_trace) store_block<Effects>(block_histories, block.entry, range.from, block.touching, histories);
  add_block(block, result);
  result.contacts = block.touching;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
