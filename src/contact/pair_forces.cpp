#include "contact/pair_forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vibrosow {

void add_figures(const LawFigures& figures, ContactStatistics& statistics) {
  statistics.slip_raised += std::llround(figures.slip_raised);
  statistics.max_relative_overlap = std::max(statistics.max_relative_overlap, figures.max_relative_overlap);
}

void add_pair_forces(PairKernel kernel, const GrainSurfaces& grains, const Motion& at, const PairList& list,
                     PairRange range, const ContactParameters& parameters, const ContactStep& step,
                     ContactHistories& histories, GrainRange fresh, Forces& forces, std::vector<ForeignForce>& foreign,
                     ContactStatistics& statistics) {
  PairResult result;
  result.forces = forces.data(), result.first_own = fresh.from;
  int begun = fresh.from;
  const auto begin_up_to = [&](int end) {  // just before they are added to, and still in the cache then
    if (end > begun) std::memset(forces.data() + begun, 0, sizeof(GrainForce) * static_cast<std::size_t>(end - begun));
    begun = std::max(begun, end);
  };
  for (int from = range.from; from < range.to; from += pair_block_size) {
    const int to = std::min(from + pair_block_size, range.to);
    begin_up_to(std::min(list.grain[static_cast<std::size_t>(to) - 1] + 1, fresh.to));
    kernel(grains, at, list, {from, to}, parameters, step, histories, result);
    foreign.insert(foreign.end(), result.foreign, result.foreign + result.foreign_count);
    statistics.contacts += result.contacts;
    add_figures(result.figures, statistics);
  }
  begin_up_to(fresh.to);
}

}  // namespace vibrosow
