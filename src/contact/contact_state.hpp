#pragma once

#include <vector>

#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"

namespace vibrosow {

/// Contacts of a run, from step to step: which pairs and walls may touch (sorted, more than do), what those that touch
/// have been through, and on which side of a wall each grain stands. Grains are numbered as the kernels see them: a
/// clump's discs each on its own.
struct ContactState {
  PairList pairs;
  PairList boundary_pairs;  // across the periodic boundary: the row's grain, near the left side, moved by a period
  std::vector<WallCandidate> walls;
  ContactHistories pair_histories, boundary_histories, wall_histories;  // by entry of these lists
};

/// The same with no more candidates than have a history: all that a later step depends on. Lists made from it anew hold
/// the same contacts, whatever other candidates they hold beside.
ContactState without_idle_candidates(const ContactState& contacts);

}  // namespace vibrosow
