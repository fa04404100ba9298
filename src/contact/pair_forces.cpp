#include "contact/pair_forces.hpp"

#include <algorithm>

namespace vibrosow {

void add_pair_forces(PairKernel kernel, const GrainSurfaces& grains, const Motion& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const HistoryAdvance& advance,
                     ContactHistory& history, int first_own, Forces& forces, std::vector<ForeignForce>& foreign,
                     ContactCensus& census) {
  PairResult result;
  result.forces = forces.data(), result.first_own = first_own;
  for (int from = range.from; from < range.to; from += pair_block_size) {
    kernel(grains, at, list, {from, std::min(from + pair_block_size, range.to)}, parameters, advance, history, result);
    foreign.insert(foreign.end(), result.foreign, result.foreign + result.foreign_count);
    census.contacts += result.contacts;
    census.max_compression = std::max(census.max_compression, result.max_compression);
  }
}

}  // namespace vibrosow
