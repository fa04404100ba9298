#include "simulation/neighbours.hpp"

#include <algorithm>
#include <utility>

#include "contact/wall_kernel.hpp"

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
}

/// Drops entries whose flag in `kept_entries` was not set; the history then matches a list shortened the same way.
void keep_entries(ContactHistory& history, const std::vector<std::size_t>& kept_entries) {
  for (std::size_t k = 0; k < kept_entries.size(); ++k) copy_entry(history, kept_entries[k], history, k);
  history.resize(kept_entries.size(), !history.slip.empty(), !history.roll.empty());
}

void renumber(PairList& list, ContactHistory& history, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  PairList kept;
  std::vector<std::size_t> kept_entries;
  kept.partner.reserve(list.size());
  kept.first.reserve(list.first.size());
  for (std::size_t i = 0; i < list.grains(); ++i) {
    if (removed[i]) continue;
    for (int k = list.first[i]; k < list.first[i + 1]; ++k) {
      const std::size_t entry = static_cast<std::size_t>(k), j = static_cast<std::size_t>(list.partner[entry]);
      if (removed[j]) continue;
      kept.partner.push_back(new_index[j]);
      kept_entries.push_back(entry);
    }
    kept.first.push_back(static_cast<int>(kept.partner.size()));
  }
  list = std::move(kept);
  keep_entries(history, kept_entries);
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

/// What the pairs of `from` remember, for those of them that are in `to` as well; both lists are sorted.
void carry_over(const PairList& from, const ContactHistory& old, const PairList& to, ContactHistory& history) {
  for (std::size_t i = 0; i < std::min(from.grains(), to.grains()); ++i) {
    int known = from.first[i];
    for (int k = to.first[i]; k < to.first[i + 1]; ++k) {
      const int partner = to.partner[static_cast<std::size_t>(k)];
      while (known < from.first[i + 1] && from.partner[static_cast<std::size_t>(known)] < partner) ++known;
      if (known < from.first[i + 1] && from.partner[static_cast<std::size_t>(known)] == partner)
        copy_entry(old, static_cast<std::size_t>(known), history, static_cast<std::size_t>(k));
    }
  }
}

}  // namespace

Neighbours::Neighbours(const std::vector<Vessel>& vessels, double largest_diameter, NeighbourMargins margins,
                       NeighbourMemory memory)
    : broadphase_(vessels, largest_diameter),
      wide_margin_(margins.wide * largest_diameter),
      narrow_margin_(margins.narrow * largest_diameter),
      memory_(memory) {}

Neighbours::Reference Neighbours::reference(const Grains& grains, const Walls& walls) {
  const Eigen::Vector2d shift = walls.displacement().front();
  Reference now{grains.x, grains.y, walls.displacement()};
  for (double& x : now.x) x -= shift.x();
  for (double& y : now.y) y -= shift.y();
  return now;
}

bool Neighbours::moved(const Reference& from, const Grains& grains, const Walls& walls, double limit) {
  const Eigen::Vector2d shift = walls.displacement().front();
  const double limit2 = limit * limit, shift_x = shift.x(), shift_y = shift.y();
  const double *x = grains.x.data(), *y = grains.y.data(), *fx = from.x.data(), *fy = from.y.data();
  int far = 0;  // a flag without a branch: the loop becomes vector instructions
  for (std::size_t i = 0; i < from.x.size(); ++i) {
    const double dx = x[i] - shift_x - fx[i], dy = y[i] - shift_y - fy[i];
    far |= dx * dx + dy * dy > limit2 ? 1 : 0;
  }
  for (std::size_t v = 1; v < from.displacement.size(); ++v) {
    const Eigen::Vector2d relative_now = walls.displacement()[v] - shift;
    const Eigen::Vector2d relative_then = from.displacement[v] - from.displacement.front();
    far |= (relative_now - relative_then).squaredNorm() > limit2 ? 1 : 0;
  }
  return far != 0;
}

void Neighbours::update(const Grains& grains, const Walls& walls) {
  // Two that were further apart than their reach plus a margin have touched only if they moved half the margin each.
  if (wide_is_valid_ && !moved(narrow_reference_, grains, walls, 0.5 * narrow_margin_)) return;
  if (!wide_is_valid_ || moved(wide_reference_, grains, walls, 0.5 * (wide_margin_ - narrow_margin_)))
    search(grains, walls);
  prune(grains, walls);
}

void Neighbours::search(const Grains& grains, const Walls& walls) {
  broadphase_.find(grains, walls.displacement(), wide_margin_, wide_, wide_walls_);
  wide_reference_ = reference(grains, walls);
  wide_is_valid_ = true;
  ++searches_;
}

void Neighbours::prune(const Grains& grains, const Walls& walls) {
  const bool remembers = memory_.slip || memory_.roll;
  PairList old_pairs;
  if (remembers) old_pairs = narrow_;
  prune_pairs(grains);
  if (remembers) {
    const ContactHistory old = std::move(pair_history_);
    pair_history_ = {};
    pair_history_.resize(narrow_.size(), memory_.slip, memory_.roll);
    carry_over(old_pairs, old, narrow_, pair_history_);
  }
  prune_walls(grains, walls);
  narrow_reference_ = reference(grains, walls);
  ++prunes_;
}

void Neighbours::prune_pairs(const Grains& grains) {
  narrow_.first.assign(1, 0);
  narrow_.partner.clear();
  const bool clumps = !grains.clump.empty();
  for (std::size_t i = 0; i < wide_.grains(); ++i) {
    const double reach = grains.kind(i).radius + narrow_margin_;
    for (int k = wide_.first[i]; k < wide_.first[i + 1]; ++k) {
      const int partner = wide_.partner[static_cast<std::size_t>(k)];
      const std::size_t j = static_cast<std::size_t>(partner);
      if (clumps && grains.clump[i] == grains.clump[j]) continue;
      const double dx = grains.x[j] - grains.x[i], dy = grains.y[j] - grains.y[i];
      const double limit = reach + grains.kind(j).radius;
      if (dx * dx + dy * dy < limit * limit) narrow_.partner.push_back(partner);
    }
    narrow_.first.push_back(static_cast<int>(narrow_.partner.size()));
  }
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

void Neighbours::remove_flagged(const std::vector<char>& removed) {
  if (!wide_is_valid_) return;
  std::vector<int> new_index(removed.size());
  int next = 0;
  for (std::size_t i = 0; i < removed.size(); ++i) new_index[i] = removed[i] ? -1 : next++;
  ContactHistory none;
  renumber(wide_, none, removed, new_index);
  renumber(narrow_, pair_history_, removed, new_index);
  renumber(wide_walls_, none, removed, new_index);
  renumber(narrow_walls_, wall_history_, removed, new_index);
  remove_flagged(wide_reference_, removed);
  remove_flagged(narrow_reference_, removed);
}

}  // namespace vibrosow
