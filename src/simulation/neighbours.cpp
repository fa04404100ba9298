#include "simulation/neighbours.hpp"

#include <algorithm>
#include <atomic>
#include <boost/iterator/counting_iterator.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "vessel/nearest_point.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

void keep_unflagged(std::vector<double>& array, const std::vector<char>& removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < array.size(); ++i)
    if (!removed[i]) array[kept++] = array[i];
  array.resize(kept);
}

void renumber(PairList& list, ContactHistories& histories, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  const bool have_history = !histories.touched.empty();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(list.grain[k]), j = static_cast<std::size_t>(list.partner[k]);
    if (removed[i] || removed[j]) continue;
    if (have_history) histories.copy_entry(kept, histories, k);
    list.grain[kept] = new_index[i], list.partner[kept++] = new_index[j];
  }
  list.grain.resize(kept), list.partner.resize(kept);
  if (have_history) histories.resize(kept, histories.kinds);
}

/// Keeps the candidates of a list for which `keep` is true, with their histories.
template <class Keep>
void keep_candidates(std::vector<WallCandidate>& list, ContactHistories& histories, Keep keep) {
  std::vector<std::size_t> kept_entries;
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (!keep(list[c])) continue;
    list[kept_entries.size()] = list[c];
    kept_entries.push_back(c);
  }
  list.resize(kept_entries.size());
  histories.keep_entries(kept_entries);
}

void renumber(std::vector<WallCandidate>& list, ContactHistories& histories, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  keep_candidates(list, histories, [&](const WallCandidate& c) { return !removed[static_cast<std::size_t>(c.grain)]; });
  for (WallCandidate& c : list) c.grain = new_index[static_cast<std::size_t>(c.grain)];
}

/// A pair with a history, whichever of the two comes first in its list.
struct ActivePair {
  int low, high;
  const ContactHistories* histories;
  std::size_t entry;
};
bool operator<(const ActivePair& a, const ActivePair& b) {
  return a.low != b.low ? a.low < b.low : a.high < b.high;
}

void add_active_pairs(const PairList& list, const ContactHistories& histories, std::vector<ActivePair>& active) {
  for (std::size_t k = 0; k < list.size(); ++k)
    if (histories.has_history(k))
      active.push_back(
          {std::min(list.grain[k], list.partner[k]), std::max(list.grain[k], list.partner[k]), &histories, k});
}

/// Of both lists, sorted: a grain carried from one side to the other takes its contacts from one list to the other.
std::vector<ActivePair> active_pairs(const PairList& pairs, const ContactHistories& histories, const PairList& boundary,
                                     const ContactHistories& boundary_histories) {
  std::vector<ActivePair> active;
  add_active_pairs(pairs, histories, active);
  add_active_pairs(boundary, boundary_histories, active);
  std::sort(active.begin(), active.end());
  return active;
}

void carry_over(const std::vector<ActivePair>& active, const PairList& list, ContactHistories& histories) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const ActivePair wanted{std::min(list.grain[k], list.partner[k]), std::max(list.grain[k], list.partner[k]), nullptr,
                            0};
    const auto found = std::lower_bound(active.begin(), active.end(), wanted);
    if (found != active.end() && !(wanted < *found)) histories.copy_entry(k, *found->histories, found->entry);
  }
}

void drop_pairs_within_clumps(const std::vector<int>& clump, PairList& list) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (clump[static_cast<std::size_t>(list.grain[k])] == clump[static_cast<std::size_t>(list.partner[k])]) continue;
    list.grain[kept] = list.grain[k], list.partner[kept++] = list.partner[k];
  }
  list.grain.resize(kept), list.partner.resize(kept);
}

/// The same where both lists know each pair by the same order, for entries [from, to) of the new one: one search.
void carry_over(const PairList& old, const ContactHistories& old_histories, const PairList& list, std::size_t from,
                std::size_t to, ContactHistories& histories) {
  const auto pair_of = [](const PairList& pairs, std::size_t k) {
    return std::int64_t{pairs.grain[k]} << 32 | std::int64_t{pairs.partner[k]};
  };
  if (from == to) return;
  const std::size_t end = old.size();
  using Entry = boost::counting_iterator<std::size_t>;
  std::size_t k = *std::partition_point(Entry(0), Entry(end),
                                        [&](std::size_t entry) { return pair_of(old, entry) < pair_of(list, from); });
  for (std::size_t m = from; m < to && k < end; ++m) {
    const std::int64_t pair = pair_of(list, m);
    while (k < end && pair_of(old, k) < pair) ++k;
    if (k < end && pair_of(old, k) == pair && old_histories.touched[k]) histories.copy_entry(m, old_histories, k);
  }
}

}  // namespace

Neighbours::Neighbours(const std::vector<Vessel>& vessels, double largest_diameter, NeighbourMargins margins,
                       HistoryKinds kinds, Execution& execution)
    : execution_(execution),
      broadphase_(vessels, largest_diameter, execution.instructions()),
      diameter_(largest_diameter),
      wide_margin_(margins.wide * largest_diameter),
      narrow_margin_(margins.narrow * largest_diameter),
      kinds_(kinds),
      period_(vessels.front().sides == Sides::periodic ? vessels.front().length : 0) {
  for (const Vessel& vessel : vessels) largest_radius_.push_back(largest_radius(vessel, Eigen::Vector2d::Zero()));
}

void Neighbours::note(const Grains& grains, const Walls& walls, Reference& reference) {
  const Eigen::Vector2d shift = walls.poses().front().displacement;
  reference.x = grains.x, reference.y = grains.y, reference.poses = walls.poses();
  for (double& x : reference.x) x -= shift.x();
  for (double& y : reference.y) y -= shift.y();
}

bool Neighbours::moved(const Reference& from, const Grains& grains, const Walls& walls, double limit) const {
  const Eigen::Vector2d shift = walls.poses().front().displacement;
  std::atomic<bool> any = false;
  execution_.share(from.x.size(), [&](std::size_t a, std::size_t b) {
    if (execution_.loops().any_moved(b - a, grains.x.data() + a, grains.y.data() + a, shift.x(), shift.y(),
                                     from.x.data() + a, from.y.data() + a, limit))
      any = true;
  });
  if (any) return true;
  for (std::size_t v = 0; v < from.poses.size(); ++v) {
    const Pose &now = walls.poses()[v], &then = from.poses[v];
    const Eigen::Vector2d relative_now = now.displacement - shift;
    const Eigen::Vector2d relative_then = then.displacement - from.poses.front().displacement;
    const double turned = std::abs(now.angle - then.angle) * largest_radius_[v];
    if ((relative_now - relative_then).norm() + turned > limit) return true;
  }
  return false;
}

void Neighbours::update(const Grains& grains, const Walls& walls, ContactState& contacts) {
  // Two that were further apart than their reach plus a margin have touched only if they moved half the margin each.
  ++updates_since_prune_;
  if (wide_is_valid_ && !moved(narrow_reference_, grains, walls, 0.5 * narrow_margin_)) return;
  choose_narrow_margin();
  if (!wide_is_valid_ || moved(wide_reference_, grains, walls, 0.5 * (wide_margin_ - narrow_margin_)))
    search(grains, walls);
  prune(grains, walls, contacts);
}

/// A margin m costs c m at every update, in pairs looked at for nothing, and P every T updates, when the list is
/// pruned; T grows as m, so that both are least together where they are alike: m^2 = P m_before / (c T_before). Counted
/// in updates, not in seconds: a run's lists are the same wherever it runs.
void Neighbours::choose_narrow_margin() {
  constexpr double prune_per_candidate_cost = 12;  // P / c, in diameters; measured on shaken trays
  constexpr double least = 0.02, most = 0.35;      // diameters
  if (updates_since_prune_ > 1) {
    const double before = narrow_margin_ / diameter_;
    const double best = std::sqrt(prune_per_candidate_cost * before / static_cast<double>(updates_since_prune_));
    narrow_margin_ = std::min(std::clamp(best, least, most) * diameter_, 0.5 * wide_margin_);
  }
  updates_since_prune_ = 0;
}

void Neighbours::search(const Grains& grains, const Walls& walls) {
  execution_.stop_if_asked();  // a search among millions takes seconds
  const Ranges ranges{execution_.threads(), [this](const auto& work) {
                        execution_.stop_if_asked();
                        execution_.for_each_range(work);
                      }};
  broadphase_.find(grains, walls.poses(), wide_margin_, ranges, wide_, wide_walls_);
  if (period_ > 0) broadphase_.find_across(period_, wide_margin_, ranges, wide_boundary_);
  if (!grains.clump.empty())
    drop_pairs_within_clumps(grains.clump, wide_), drop_pairs_within_clumps(grains.clump, wide_boundary_);
  note(grains, walls, wide_reference_);
  wide_is_valid_ = true;
  ++searches_;
}

/// Of the entries [from, to) of a wide list, keeps the pairs nearer than their reach plus the narrow margin, with the
/// rows' grains shifted by `shift` (m) along x.
void Neighbours::prune_range(const Grains& grains, const PairList& wide, std::size_t from, std::size_t to, double shift,
                             PairList& narrow) const {
  const PerGrain radius{grains.polydisperse ? grains.radius.data() : nullptr, grains.kinds.front().radius};
  constexpr std::size_t chunk = 4096;  // of the wide list: the narrow one is never much longer than it must be
  std::size_t near = 0;
  for (; from < to; from += chunk) {
    const std::size_t count = std::min(chunk, to - from);
    if (narrow.grain.size() < near + count + 16)
      narrow.grain.resize(near + count + 16), narrow.partner.resize(near + count + 16);
    near +=
        execution_.loops().near_pairs(count, &wide.grain[from], &wide.partner[from], grains.x.data(), grains.y.data(),
                                      shift, radius, narrow_margin_, &narrow.grain[near], &narrow.partner[near]);
  }
  narrow.grain.resize(near), narrow.partner.resize(near);
}

void Neighbours::prune_pairs(const Grains& grains, const PairList& wide, double shift, PairList& narrow) {
  const std::size_t threads = static_cast<std::size_t>(execution_.threads());
  if (threads == 1) return prune_range(grains, wide, 0, wide.size(), shift, narrow);
  parts_.resize(threads);
  execution_.for_each_range([&](int range) {
    const std::size_t k = static_cast<std::size_t>(range);
    prune_range(grains, wide, wide.size() * k / threads, wide.size() * (k + 1) / threads, shift, parts_[k]);
  });
  narrow.clear();
  for (const PairList& part : parts_) {
    narrow.grain.insert(narrow.grain.end(), part.grain.begin(), part.grain.end());
    narrow.partner.insert(narrow.partner.end(), part.partner.begin(), part.partner.end());
  }
}

void Neighbours::prune(const Grains& grains, const Walls& walls, ContactState& contacts) {
  execution_.stop_if_asked();
  std::swap(contacts.pairs, old_), std::swap(contacts.boundary_pairs, old_boundary_);
  prune_pairs(grains, wide_, 0, contacts.pairs);
  contacts.boundary_pairs.clear();
  if (period_ > 0) prune_pairs(grains, wide_boundary_, period_, contacts.boundary_pairs);
  if (kinds_.any()) {
    std::swap(contacts.pair_histories, old_histories_), std::swap(contacts.boundary_histories, old_boundary_histories_);
    contacts.pair_histories.clear(), contacts.boundary_histories.clear();
    contacts.pair_histories.resize(contacts.pairs.size(), kinds_);
    contacts.boundary_histories.resize(contacts.boundary_pairs.size(), kinds_);
    if (period_ > 0) {
      const std::vector<ActivePair> active = active_pairs(old_, old_histories_, old_boundary_, old_boundary_histories_);
      carry_over(active, contacts.pairs, contacts.pair_histories);
      carry_over(active, contacts.boundary_pairs, contacts.boundary_histories);
    } else {
      execution_.share(contacts.pairs.size(), [&](std::size_t from, std::size_t to) {
        carry_over(old_, old_histories_, contacts.pairs, from, to, contacts.pair_histories);
      });
    }
  }
  prune_walls(grains, walls, contacts);
  note(grains, walls, narrow_reference_);
  ++prunes_;
}

/// A grain that was near a wall before keeps the side it came from: renewing the list must not hide a crossing.
void Neighbours::prune_walls(const Grains& grains, const Walls& walls, ContactState& contacts) {
  const auto before = [](const WallCandidate& a, const WallCandidate& b) {
    return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
  };
  const std::vector<WallCandidate> old = std::move(contacts.walls);
  const ContactHistories old_histories = std::move(contacts.wall_histories);
  std::vector<std::pair<std::size_t, std::size_t>> known_before;  // old entry, new entry
  contacts.walls.clear();
  auto known = old.begin();
  for (const WallCandidate& candidate : wide_walls_) {
    const std::size_t i = static_cast<std::size_t>(candidate.grain);
    const NearestPoint nearest =
        nearest_point(walls.placed()[static_cast<std::size_t>(candidate.wall)], grains.x[i], grains.y[i]);
    const double reach = grains.kind(i).radius + narrow_margin_;
    if (nearest.distance2 >= reach * reach) continue;
    while (known != old.end() && before(*known, candidate)) ++known;
    const bool was_near = known != old.end() && !before(candidate, *known);
    if (was_near) known_before.emplace_back(static_cast<std::size_t>(known - old.begin()), contacts.walls.size());
    contacts.walls.push_back({candidate.grain, candidate.wall, was_near ? known->side : nearest.side});
  }
  contacts.wall_histories = {};
  contacts.wall_histories.resize(contacts.walls.size(), kinds_);
  for (const auto& [old_entry, entry] : known_before)
    contacts.wall_histories.copy_entry(entry, old_histories, old_entry);
}

void Neighbours::remove_flagged(Reference& reference, const std::vector<char>& removed) {
  keep_unflagged(reference.x, removed);
  keep_unflagged(reference.y, removed);
}

void Neighbours::remove_wall(int wall, ContactState& contacts) {
  broadphase_.remove_wall(wall);
  std::erase_if(wide_walls_, [wall](const WallCandidate& candidate) { return candidate.wall == wall; });
  keep_candidates(contacts.walls, contacts.wall_histories,
                  [wall](const WallCandidate& candidate) { return candidate.wall != wall; });
}

void Neighbours::restore_wall(int wall) {
  broadphase_.restore_wall(wall);
  start_afresh();
}

void Neighbours::remove_flagged(const std::vector<char>& removed, ContactState& contacts) {
  std::vector<int> new_index(removed.size());
  int next = 0;
  for (std::size_t i = 0; i < removed.size(); ++i) new_index[i] = removed[i] ? -1 : next++;
  ContactHistories none;
  renumber(contacts.pairs, contacts.pair_histories, removed, new_index);
  renumber(contacts.boundary_pairs, contacts.boundary_histories, removed, new_index);
  renumber(contacts.walls, contacts.wall_histories, removed, new_index);
  if (!wide_is_valid_) return;
  renumber(wide_, none, removed, new_index);
  if (period_ > 0) renumber(wide_boundary_, none, removed, new_index);
  renumber(wide_walls_, none, removed, new_index);
  remove_flagged(wide_reference_, removed);
  remove_flagged(narrow_reference_, removed);
}

}  // namespace vibrosow
