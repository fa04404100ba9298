#include "contact/pair_forces.hpp"

#include <algorithm>

namespace vibrosow {
namespace {

template <bool rotation>
void add_block(const PairBlock& block, const PairList& list, int first_own, Forces& forces,
               std::vector<ForeignForce>& foreign) {
  double *fx = forces.fx.data(), *fy = forces.fy.data(), *torque = forces.torque.data();
  const int *grain = list.grain.data(), *partner = list.partner.data();
  for (int k = 0; k < block.touching; ++k) {
    const std::size_t i = static_cast<std::size_t>(grain[block.entry[k]]);
    const std::size_t j = static_cast<std::size_t>(partner[block.entry[k]]);
    fx[i] -= block.fx[k], fy[i] -= block.fy[k];
    if constexpr (rotation) torque[i] += block.torque[k];
    if (static_cast<int>(j) < first_own) {
      foreign.push_back({static_cast<int>(j), block.fx[k], block.fy[k], rotation ? block.partner_torque[k] : 0.0});
      continue;
    }
    fx[j] += block.fx[k], fy[j] += block.fy[k];
    if constexpr (rotation) torque[j] += block.partner_torque[k];
  }
}

}  // namespace

void add_pair_forces(const ChosenKernel& kernel, const GrainSurfaces& grains, const Motion& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const HistoryAdvance& advance,
                     ContactHistory& history, int first_own, Forces& forces, std::vector<ForeignForce>& foreign,
                     ContactCensus& census) {
  const auto add = kernel.rotation ? add_block<true> : add_block<false>;
  PairBlock block;
  for (int from = range.from; from < range.to; from += PairBlock::size) {
    kernel.pair(grains, at, list, {from, std::min(from + PairBlock::size, range.to)}, parameters, advance, history,
                block);
    add(block, list, first_own, forces, foreign);
    census.contacts += block.touching;
    census.max_compression = std::max(census.max_compression, block.max_compression);
  }
}

}  // namespace vibrosow
