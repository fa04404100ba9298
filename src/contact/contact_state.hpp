#pragma once

#include <vector>

#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"

namespace vibrosow {

/// Pairs across a periodic boundary: the row's grain, near the left side (or the front), is moved by a period.
struct BoundaryContacts {
  PairList pairs;
  ContactHistories histories;
};

/// Contacts of a run, from step to step: which pairs and walls may touch (sorted, more than do), what those that touch
/// have been through, and on which side of a wall each grain stands. Grains are numbered as the kernels see them: a
/// clump's discs each on its own.
struct ContactState {
  PairList pairs;
  std::vector<BoundaryContacts> boundaries;  // by Neighbours::images; none where nothing is periodic
  std::vector<WallCandidate> walls;
  ContactHistories pair_histories, wall_histories;  // by entry of these lists
};

/// The same with no more candidates than have a history: all that a later step depends on. Lists made from it anew hold
/// the same contacts, whatever other candidates they hold beside.
ContactState without_idle_candidates(const ContactState& contacts);

}  // namespace vibrosow
