#include "simulation/neighbours.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <ranges>
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

void copy_entry(const ContactHistory& from, std::size_t old_entry, ContactHistory& to, std::size_t entry) {
  if (!to.slip.empty()) to.slip[entry] = from.slip[old_entry], to.slip_speed[entry] = from.slip_speed[old_entry];
  if (!to.roll.empty()) to.roll[entry] = from.roll[old_entry], to.roll_speed[entry] = from.roll_speed[old_entry];
  if (!to.touched.empty()) to.touched[entry] = 1;
}

/// Drops entries whose flag in `kept_entries` was not set; the history then matches a list shortened the same way.
void keep_entries(ContactHistory& history, const std::vector<std::size_t>& kept_entries) {
  for (std::size_t k = 0; k < kept_entries.size(); ++k) copy_entry(history, kept_entries[k], history, k);
  history.resize(kept_entries.size(), !history.slip.empty(), !history.roll.empty());
}

void renumber(PairList& list, ContactHistory& history, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  const bool memory = !history.touched.empty();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(list.grain[k]), j = static_cast<std::size_t>(list.partner[k]);
    if (removed[i] || removed[j]) continue;
    if (memory) copy_entry(history, k, history, kept);
    list.grain[kept] = new_index[i], list.partner[kept++] = new_index[j];
  }
  list.grain.resize(kept), list.partner.resize(kept);
  if (memory) history.resize(kept, !history.slip.empty(), !history.roll.empty());
}

void renumber(std::vector<WallCandidate>& list, ContactHistory& history, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  std::vector<std::size_t> kept_entries;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const std::size_t i = static_cast<std::size_t>(list[c].grain);
    if (removed[i]) continue;
    list[kept_entries.size()] = {new_index[i], list[c].wall, list[c].side};
    kept_entries.push_back(c);
  }
  list.resize(kept_entries.size());
  keep_entries(history, kept_entries);
}

/// A pair that remembers something, whichever of the two comes first in its list.
struct RememberedPair {
  int low, high;
  const ContactHistory* history;
  std::size_t entry;
};
bool operator<(const RememberedPair& a, const RememberedPair& b) {
  return a.low != b.low ? a.low < b.low : a.high < b.high;
}

void add_active_pairs(const PairList& list, const ContactHistory& history, std::vector<RememberedPair>& active) {
  for (std::size_t k = 0; k < list.size(); ++k)
    if (history.remembers(k))
      active.push_back(
          {std::min(list.grain[k], list.partner[k]), std::max(list.grain[k], list.partner[k]), &history, k});
}

/// Of both lists, sorted: a grain carried from one side to the other takes its contacts from one list to the other.
std::vector<RememberedPair> active_pairs(const PairList& pairs, const ContactHistory& history, const PairList& boundary,
                                         const ContactHistory& boundary_history) {
  std::vector<RememberedPair> active;
  add_active_pairs(pairs, history, active);
  add_active_pairs(boundary, boundary_history, active);
  std::sort(active.begin(), active.end());
  return active;
}

void recall(const std::vector<RememberedPair>& remembered, const PairList& list, ContactHistory& history) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const RememberedPair wanted{std::min(list.grain[k], list.partner[k]), std::max(list.grain[k], list.partner[k]),
                                nullptr, 0};
    const auto found = std::lower_bound(remembered.begin(), remembered.end(), wanted);
    if (found != remembered.end() && !(wanted < *found)) copy_entry(*found->history, found->entry, history, k);
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
void carry_over(const PairList& old, const ContactHistory& old_history, const PairList& list, std::size_t from,
                std::size_t to, ContactHistory& history) {
  const auto pair_of = [](const PairList& pairs, std::size_t k) {
    return std::int64_t{pairs.grain[k]} << 32 | std::int64_t{pairs.partner[k]};
  };
  if (from == to) return;
  const std::size_t end = old.size();
  std::size_t k = *std::ranges::partition_point(std::views::iota(std::size_t{0}, end), [&](std::size_t entry) {
    return pair_of(old, entry) < pair_of(list, from);
  });
  for (std::size_t m = from; m < to && k < end; ++m) {
    const std::int64_t pair = pair_of(list, m);
    while (k < end && pair_of(old, k) < pair) ++k;
    if (k < end && pair_of(old, k) == pair && old_history.touched[k]) copy_entry(old_history, k, history, m);
  }
}

}  // namespace

Neighbours::Neighbours(const std::vector<Vessel>& vessels, double largest_diameter, NeighbourMargins margins,
                       NeighbourMemory memory, Execution& execution)
    : execution_(execution),
      broadphase_(vessels, largest_diameter, execution.instructions()),
      diameter_(largest_diameter),
      wide_margin_(margins.wide * largest_diameter),
      narrow_margin_(margins.narrow * largest_diameter),
      memory_(memory),
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

void Neighbours::update(const Grains& grains, const Walls& walls) {
  // Two that were further apart than their reach plus a margin have touched only if they moved half the margin each.
  ++updates_since_prune_;
  if (wide_is_valid_ && !moved(narrow_reference_, grains, walls, 0.5 * narrow_margin_)) return;
  choose_narrow_margin();
  if (!wide_is_valid_ || moved(wide_reference_, grains, walls, 0.5 * (wide_margin_ - narrow_margin_)))
    search(grains, walls);
  prune(grains, walls);
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
  const Ranges ranges{execution_.threads(), [this](const auto& work) { execution_.for_each_range(work); }};
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

void Neighbours::prune(const Grains& grains, const Walls& walls) {
  std::swap(narrow_, old_), std::swap(narrow_boundary_, old_boundary_);
  prune_pairs(grains, wide_, 0, narrow_);
  if (period_ > 0) prune_pairs(grains, wide_boundary_, period_, narrow_boundary_);
  if (memory_.any()) {
    std::swap(pair_history_, old_history_), std::swap(boundary_history_, old_boundary_history_);
    pair_history_.clear(), boundary_history_.clear();
    pair_history_.resize(narrow_.size(), memory_.slip, memory_.roll);
    boundary_history_.resize(narrow_boundary_.size(), memory_.slip, memory_.roll);
    if (period_ > 0) {
      const std::vector<RememberedPair> remembered =
          active_pairs(old_, old_history_, old_boundary_, old_boundary_history_);
      recall(remembered, narrow_, pair_history_);
      recall(remembered, narrow_boundary_, boundary_history_);
    } else {
      execution_.share(narrow_.size(), [&](std::size_t from, std::size_t to) {
        carry_over(old_, old_history_, narrow_, from, to, pair_history_);
      });
    }
  }
  prune_walls(grains, walls);
  note(grains, walls, narrow_reference_);
  ++prunes_;
}

/// A grain that was near a wall before keeps the side it came from: renewing the list must not hide a crossing.
void Neighbours::prune_walls(const Grains& grains, const Walls& walls) {
  const auto before = [](const WallCandidate& a, const WallCandidate& b) {
    return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
  };
  const std::vector<WallCandidate> old = std::move(narrow_walls_);
  const ContactHistory old_history = std::move(wall_history_);
  std::vector<std::pair<std::size_t, std::size_t>> remembered;  // old entry, new entry
  narrow_walls_.clear();
  auto known = old.begin();
  for (const WallCandidate& candidate : wide_walls_) {
    const std::size_t i = static_cast<std::size_t>(candidate.grain);
    const NearestPoint nearest =
        nearest_point(walls.placed()[static_cast<std::size_t>(candidate.wall)], grains.x[i], grains.y[i]);
    const double reach = grains.kind(i).radius + narrow_margin_;
    if (nearest.distance2 >= reach * reach) continue;
    while (known != old.end() && before(*known, candidate)) ++known;
    const bool was_near = known != old.end() && !before(candidate, *known);
    if (was_near) remembered.emplace_back(static_cast<std::size_t>(known - old.begin()), narrow_walls_.size());
    narrow_walls_.push_back({candidate.grain, candidate.wall, was_near ? known->side : nearest.side});
  }
  wall_history_ = {};
  wall_history_.resize(narrow_walls_.size(), memory_.slip, memory_.roll);
  for (const auto& [old_entry, entry] : remembered) copy_entry(old_history, old_entry, wall_history_, entry);
}

void Neighbours::remove_flagged(Reference& reference, const std::vector<char>& removed) {
  keep_unflagged(reference.x, removed);
  keep_unflagged(reference.y, removed);
}

void Neighbours::remove_wall(int wall) {
  broadphase_.remove_wall(wall);
  std::erase_if(wide_walls_, [wall](const WallCandidate& candidate) { return candidate.wall == wall; });
  std::vector<std::size_t> kept_entries;
  for (std::size_t c = 0; c < narrow_walls_.size(); ++c) {
    if (narrow_walls_[c].wall == wall) continue;
    narrow_walls_[kept_entries.size()] = narrow_walls_[c];
    kept_entries.push_back(c);
  }
  narrow_walls_.resize(kept_entries.size());
  keep_entries(wall_history_, kept_entries);
}

void Neighbours::remove_flagged(const std::vector<char>& removed) {
  if (!wide_is_valid_) return;
  std::vector<int> new_index(removed.size());
  int next = 0;
  for (std::size_t i = 0; i < removed.size(); ++i) new_index[i] = removed[i] ? -1 : next++;
  ContactHistory none;
  renumber(wide_, none, removed, new_index);
  renumber(narrow_, pair_history_, removed, new_index);
  if (period_ > 0) {
    renumber(wide_boundary_, none, removed, new_index);
    renumber(narrow_boundary_, boundary_history_, removed, new_index);
  }
  renumber(wide_walls_, none, removed, new_index);
  renumber(narrow_walls_, wall_history_, removed, new_index);
  remove_flagged(wide_reference_, removed);
  remove_flagged(narrow_reference_, removed);
}

}  // namespace vibrosow
