#pragma once

#include "contact/kernels.hpp"

namespace vibrosow {

/// Force of a contact on a grain that another range of grains owns.
struct ForeignForce {
  int grain;
  double fx, fy, torque;  // N, N m
};

/// A kernel, and whether its contacts turn the grains.
struct ChosenKernel {
  PairKernel pair;
  bool rotation;
};

/// Adds the forces of the pairs in `range` to their grains, contact by contact in the order of the list, with `kernel`.
/// Forces on grains before `first_own` go to `foreign` instead, in the same order.
void add_pair_forces(const ChosenKernel& kernel, const GrainSurfaces& grains, const Motion& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const HistoryAdvance& advance,
                     ContactHistory& history, int first_own, Forces& forces, std::vector<ForeignForce>& foreign,
                     ContactCensus& census);

}  // namespace vibrosow
