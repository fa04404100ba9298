#pragma once

#include <cmath>

#include "contact/compress.hpp"
#include "contact/pair_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <class Effects>
inline constexpr bool remembers = Effects::spring || Effects::rolling == Rolling::spring;

/// Pairs of a range that touched before and do not now remember nothing.
template <class Effects>
void forget_parted(PairRange range, const unsigned char* touches, ContactHistory& history) {
  const int count = range.to - range.from;
  unsigned char* touched = history.touched.data() + range.from;
  unsigned char parted[PairBlock::size + 16];
  int entry[PairBlock::size + 16];
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    parted[k] = static_cast<unsigned char>(touched[k] & (touches[k] ^ 1));
    touched[k] = touches[k];
  }
  const int forgotten = positions_of_set(parted, count, range.from, entry);
  for (int k = 0; k < forgotten; ++k) store<Effects>({}, history, static_cast<std::size_t>(entry[k]));
}

/// Notes the entries of a range whose grains touch. Those that do not forget, where the evaluation leaves a trace.
template <class Law, class Effects>
void find_touching(const PairProperties<Law, Effects>& properties, const Motion& at, const PairList& list,
                   PairRange range, bool leaves_trace, ContactHistory& history, PairBlock& block) {
  const double *x = at.x, *row_x = at.row_x, *y = at.y;
  const int *grain = list.grain.data() + range.from, *partner = list.partner.data() + range.from;
  const int count = range.to - range.from;
  unsigned char touches[PairBlock::size + 16];
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(grain[k]), j = static_cast<std::size_t>(partner[k]);
    const double dx = x[j] - row_x[i], dy = y[j] - y[i], reach = properties.reach(i, j);
    touches[k] = dx * dx + dy * dy < reach * reach ? 1 : 0;
  }
  if constexpr (remembers<Effects>)
    if (leaves_trace) forget_parted<Effects>(range, touches, history);
  block.touching = positions_of_set(touches, count, range.from, block.entry);
}

/// What the contacts of a block will remember.
struct BlockMemory {
  double slip[PairBlock::size], slip_speed[PairBlock::size], roll[PairBlock::size], roll_speed[PairBlock::size];
};

/// Keeps what the first `count` contacts of a block remember, at their entries of the list.
template <class Effects>
void store_block(const BlockMemory& memory, const int* entry, int count, ContactHistory& history) {
  const auto keep = [entry, count](const double* of_block, std::vector<double>& of_list) {
    double* memory_of_list = of_list.data();
    for (int k = 0; k < count; ++k) memory_of_list[entry[k]] = of_block[k];
  };
  if constexpr (Effects::spring) keep(memory.slip, history.slip), keep(memory.slip_speed, history.slip_speed);
  if constexpr (Effects::rolling == Rolling::spring)
    keep(memory.roll, history.roll), keep(memory.roll_speed, history.roll_speed);
}

template <class Law, class Effects>
[[gnu::flatten]] void forces_of_touching(const PairProperties<Law, Effects>& properties, const Motion& at,
                                         const PairList& list, const ContactParameters& parameters,
                                         const HistoryAdvance& advance_, const ContactHistory& history,
                                         PairBlock& block, BlockMemory& memory) {
  const double shortening = parameters.arm_shortening;
  const HistoryAdvance advance = advance_;
  const double *x = at.x, *y = at.y, *vx = at.vx, *vy = at.vy, *omega = at.omega, *row_x = at.row_x;
  const int *grain = list.grain.data(), *partner = list.partner.data(), *entry = block.entry;
  double max_compression = 0;
#pragma omp simd reduction(max : max_compression)
  for (int k = 0; k < block.touching; ++k) {
    const std::size_t e = static_cast<std::size_t>(entry[k]);
    const std::size_t i = static_cast<std::size_t>(grain[e]), j = static_cast<std::size_t>(partner[e]);
    const PairConstants& pair = properties.pair(i, j);
    const double dx = x[j] - row_x[i], dy = y[j] - y[i];
    const double distance = std::sqrt(dx * dx + dy * dy);
    // Coincident centres have no normal: any fixed one parts them.
    const double per_distance = 1 / distance;
    const double nx = distance > 0 ? dx * per_distance : 1, ny = distance > 0 ? dy * per_distance : 0;
    const double overlap = pair.reach - distance;
    const double compression = overlap * pair.compression_per_overlap;
    max_compression = compression > max_compression ? compression : max_compression;

    Touch touch{overlap, 0, 0, 0};
    [[maybe_unused]] double arm_i = 0, arm_j = 0;
    if constexpr (Effects::damping || Effects::friction) {
      const double ux = vx[i] - vx[j], uy = vy[i] - vy[j];
      if constexpr (Effects::damping) touch.approach = ux * nx + uy * ny;
      if constexpr (Effects::friction) touch.sliding = uy * nx - ux * ny;
      if constexpr (Effects::rotation) {
        arm_i = properties.radius(i) - shortening * overlap * pair.share_i;
        arm_j = properties.radius(j) - shortening * overlap * pair.share_j;
        touch.sliding += arm_i * omega[i] + arm_j * omega[j];
      }
      if constexpr (Effects::rolls) touch.turning = omega[i] - omega[j];
    }
    ContactMemory remembered = recall<Effects>(history, e);
    const ContactForce force = contact_force<Law, Effects>(touch, pair, properties.between(i, j), advance, remembered);
    if constexpr (Effects::spring) memory.slip[k] = remembered.slip, memory.slip_speed[k] = remembered.slip_speed;
    if constexpr (Effects::rolling == Rolling::spring)
      memory.roll[k] = remembered.roll, memory.roll_speed[k] = remembered.roll_speed;
    // On the grain: -F_n n - F_t t with t = (-n_y, n_x).
    double fx = force.normal * nx, fy = force.normal * ny;
    if constexpr (Effects::friction) fx -= force.tangential * ny, fy += force.tangential * nx;
    block.fx[k] = fx, block.fy[k] = fy;
    if constexpr (Effects::rotation) {
      block.torque[k] = force.rolling - arm_i * force.tangential;
      block.partner_torque[k] = -force.rolling - arm_j * force.tangential;
    }
  }
  block.max_compression = max_compression;
}

template <class Law, class Effects>
[[gnu::flatten]] void pair_forces(const GrainSurfaces& grains, const Motion& at, const PairList& list, PairRange range,
                                  const ContactParameters& parameters, const HistoryAdvance& advance,
                                  ContactHistory& history, PairBlock& block) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  const bool leaves_trace = advance.commit > 0;
  find_touching<Law, Effects>(properties, at, list, range, leaves_trace, history, block);
  BlockMemory memory;
  forces_of_touching<Law, Effects>(properties, at, list, parameters, advance, history, block, memory);
  if (remembers<Effects> && leaves_trace) store_block<Effects>(memory, block.entry, block.touching, history);
}

}  // namespace vibrosow::inline VIBROSOW_ISA
