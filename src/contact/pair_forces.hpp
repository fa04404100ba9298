#pragma once

#include <algorithm>
#include <vector>

#include "contact/kernels.hpp"
#include "loops/forces_3d.hpp"

namespace vibrosow {

/// Grains [from, to).
struct GrainRange {
  int from, to;
};

/// Takes a kernel's figures in.
void add_metrics(const LawMetrics& metrics, ContactStatistics& statistics);

/// As many sums of forces as there are grains; torques in 3D only where anything turns.
void resize(Forces& sums, std::size_t grains, bool rotation);
void resize(Forces3d& sums, std::size_t grains, bool rotation);

void begin_with_zero(Forces& sums, GrainRange grains);
void begin_with_zero(Forces3d& sums, GrainRange grains);

void add_foreign(const std::vector<ForeignForce>& foreign, Forces& sums);
void add_foreign(const std::vector<ForeignForce3d>& foreign, Forces3d& sums);

/// Where a kernel puts the forces of a block.
PairResult result_in(Forces& sums, int first_own);
PairResult3d result_in(Forces3d& sums, int first_own);

/// Adds the forces of the pairs in `range` to their grains, contact by contact in the order of the list, with `kernel`,
/// of the plane or of space. Forces on grains before `fresh.from` go to `foreign` instead, in the same order. Forces on
/// `fresh` grains, each of whose pairs comes with a partner of a lower number, begin with zero.
template <class Kernel, class Moving, class Sums, class Foreign>
void add_pair_forces(Kernel kernel, const GrainSurfaces& grains, const Moving& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const ContactStep& step,
                     ContactHistories& histories, GrainRange fresh, Sums& sums, std::vector<Foreign>& foreign,
                     ContactStatistics& statistics) {
  auto result = result_in(sums, fresh.from);
  int begun = fresh.from;
  const auto begin_up_to = [&](int end) {  // just before they are added to, and still in the cache then
    begin_with_zero(sums, {begun, end});
    begun = std::max(begun, end);
  };
  for (int from = range.from; from < range.to; from += pair_block_size) {
    const int to = std::min(from + pair_block_size, range.to);
    begin_up_to(std::min(list.grain[static_cast<std::size_t>(to) - 1] + 1, fresh.to));
    kernel(grains, at, list, {from, to}, parameters, step, histories, result);
    foreign.insert(foreign.end(), result.foreign, result.foreign + result.foreign_count);
    statistics.contacts += result.contacts;
    add_metrics(result.metrics, statistics);
  }
  begin_up_to(fresh.to);
}

}  // namespace vibrosow
