#include "contact/contact_state.hpp"

#include <cmath>

namespace vibrosow {
namespace {

void keep_active(PairList& list, ContactHistories& histories) {
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (histories.touched.empty() || !histories.has_history(k)) continue;
    list.grain[active.size()] = list.grain[k], list.partner[active.size()] = list.partner[k];
    active.push_back(k);
  }
  list.grain.resize(active.size()), list.partner.resize(active.size());
  histories.keep_entries(active);
}

/// A grain near a wall that has no history stands on the side where it is seen to be; of the others the sign counts.
void keep_active(std::vector<WallCandidate>& list, ContactHistories& histories) {
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (histories.touched.empty() || !histories.has_history(k)) continue;
    list[active.size()] = {list[k].grain, list[k].wall, std::copysign(1.0, list[k].side)};
    active.push_back(k);
  }
  list.resize(active.size());
  histories.keep_entries(active);
}

}  // namespace

ContactState without_idle_candidates(const ContactState& contacts) {
  ContactState state = contacts;
  keep_active(state.pairs, state.pair_histories);
  for (BoundaryContacts& boundary : state.boundaries) keep_active(boundary.pairs, boundary.histories);
  keep_active(state.walls, state.wall_histories);
  return state;
}

}  // namespace vibrosow
