#pragma once

#include "contact/kernels.hpp"

namespace vibrosow {

/// Adds the forces of the pairs in `range` to their grains, contact by contact in the order of the list, with `kernel`.
/// Forces on grains before `first_own` go to `foreign` instead, in the same order.
void add_pair_forces(PairKernel kernel, const GrainSurfaces& grains, const Motion& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const HistoryAdvance& advance,
                     ContactHistory& history, int first_own, Forces& forces, std::vector<ForeignForce>& foreign,
                     ContactCensus& census);

}  // namespace vibrosow
