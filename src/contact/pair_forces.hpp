#pragma once

#include "contact/kernels.hpp"

namespace vibrosow {

/// Grains [from, to).
struct GrainRange {
  int from, to;
};

/// Takes a kernel's figures in.
void add_figures(const LawFigures& figures, ContactStatistics& statistics);

/// Adds the forces of the pairs in `range` to their grains, contact by contact in the order of the list, with `kernel`.
/// Forces on grains before `fresh.from` go to `foreign` instead, in the same order. Forces on `fresh` grains, each of
/// whose pairs comes with a partner of a lower number, begin with zero.
void add_pair_forces(PairKernel kernel, const GrainSurfaces& grains, const Motion& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const ContactStep& step,
                     ContactHistories& histories, GrainRange fresh, Forces& forces, std::vector<ForeignForce>& foreign,
                     ContactStatistics& statistics);

}  // namespace vibrosow
