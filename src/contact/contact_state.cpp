#include "contact/contact_state.hpp"

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

}  // namespace

ContactState without_idle_pairs(const ContactState& contacts) {
  ContactState state = contacts;
  keep_active(state.pairs, state.pair_histories);
  keep_active(state.boundary_pairs, state.boundary_histories);
  return state;
}

}  // namespace vibrosow
