#include "simulation/neighbours.hpp"

#include <cmath>

#include "contact/wall_kernel.hpp"
#include "scene/vessel_walls.hpp"

namespace vibrosow {
namespace {

void keep_unflagged(std::vector<double>& array, const std::vector<char>& removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < array.size(); ++i)
    if (!removed[i]) array[kept++] = array[i];
  array.resize(kept);
}

void renumber(PairList& list, const std::vector<char>& removed, const std::vector<int>& new_index) {
  PairList kept;
  kept.partner.reserve(list.size());
  kept.first.reserve(list.first.size());
  for (std::size_t i = 0; i < list.grains(); ++i) {
    if (removed[i]) continue;
    for (int k = list.first[i]; k < list.first[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(list.partner[static_cast<std::size_t>(k)]);
      if (!removed[j]) kept.partner.push_back(new_index[j]);
    }
    kept.first.push_back(static_cast<int>(kept.partner.size()));
  }
  list = std::move(kept);
}

void renumber(std::vector<WallCandidate>& list, const std::vector<char>& removed, const std::vector<int>& new_index) {
  std::size_t kept = 0;
  for (const WallCandidate& candidate : list) {
    const std::size_t i = static_cast<std::size_t>(candidate.grain);
    if (!removed[i]) list[kept++] = {new_index[i], candidate.wall, candidate.side};
  }
  list.resize(kept);
}

/// Keeps the pairs nearer than their reach plus `margin` (m), with the rows' grains shifted by `shift` (m) along x.
void prune_pairs(const Grains& grains, const PairList& wide, double shift, double margin, PairList& narrow) {
  narrow.first.assign(1, 0);
  narrow.partner.clear();
  for (std::size_t i = 0; i < wide.grains(); ++i) {
    const double reach = grains.kind(i).radius + margin, x = grains.x[i] + shift;
    for (int k = wide.first[i]; k < wide.first[i + 1]; ++k) {
      const int partner = wide.partner[static_cast<std::size_t>(k)];
      const std::size_t j = static_cast<std::size_t>(partner);
      const double dx = grains.x[j] - x, dy = grains.y[j] - grains.y[i];
      const double limit = reach + grains.kind(j).radius;
      if (dx * dx + dy * dy < limit * limit) narrow.partner.push_back(partner);
    }
    narrow.first.push_back(static_cast<int>(narrow.partner.size()));
  }
}

}  // namespace

Neighbours::Neighbours(const std::vector<Vessel>& vessels, double largest_diameter, NeighbourMargins margins)
    : broadphase_(vessels, largest_diameter),
      wide_margin_(margins.wide * largest_diameter),
      narrow_margin_(margins.narrow * largest_diameter),
      period_(vessels.front().sides == Sides::periodic ? vessels.front().length : 0) {
  for (const Vessel& vessel : vessels) largest_radius_.push_back(largest_radius(vessel, Eigen::Vector2d::Zero()));
}

Neighbours::Reference Neighbours::reference(const Grains& grains, const Walls& walls) {
  const Eigen::Vector2d shift = walls.poses().front().displacement;
  Reference now{grains.x, grains.y, walls.poses()};
  for (double& x : now.x) x -= shift.x();
  for (double& y : now.y) y -= shift.y();
  return now;
}

bool Neighbours::moved(const Reference& from, const Grains& grains, const Walls& walls, double limit) const {
  const Eigen::Vector2d shift = walls.poses().front().displacement;
  const double limit2 = limit * limit, shift_x = shift.x(), shift_y = shift.y();
  const double *x = grains.x.data(), *y = grains.y.data(), *fx = from.x.data(), *fy = from.y.data();
  int far = 0;  // a flag without a branch: the loop becomes vector instructions
  for (std::size_t i = 0; i < from.x.size(); ++i) {
    const double dx = x[i] - shift_x - fx[i], dy = y[i] - shift_y - fy[i];
    far |= dx * dx + dy * dy > limit2 ? 1 : 0;
  }
  for (std::size_t v = 0; v < from.poses.size(); ++v) {
    const Pose &now = walls.poses()[v], &then = from.poses[v];
    const Eigen::Vector2d relative_now = now.displacement - shift;
    const Eigen::Vector2d relative_then = then.displacement - from.poses.front().displacement;
    const double turned = std::abs(now.angle - then.angle) * largest_radius_[v];
    far |= (relative_now - relative_then).norm() + turned > limit ? 1 : 0;
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
  broadphase_.find(grains, walls.poses(), wide_margin_, wide_, wide_walls_);
  if (period_ > 0) broadphase_.find_across(grains, walls.poses(), period_, wide_margin_, wide_seam_);
  wide_reference_ = reference(grains, walls);
  wide_is_valid_ = true;
  ++searches_;
}

void Neighbours::prune(const Grains& grains, const Walls& walls) {
  prune_pairs(grains, wide_, 0, narrow_margin_, narrow_);
  if (period_ > 0) prune_pairs(grains, wide_seam_, period_, narrow_margin_, narrow_seam_);
  prune_walls(grains, walls);
  narrow_reference_ = reference(grains, walls);
  ++prunes_;
}

/// A grain that was near a wall before keeps the side it came from: renewing the list must not hide a crossing.
void Neighbours::prune_walls(const Grains& grains, const Walls& walls) {
  const auto before = [](const WallCandidate& a, const WallCandidate& b) {
    return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
  };
  const std::vector<WallCandidate> old = std::move(narrow_walls_);
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
    narrow_walls_.push_back({candidate.grain, candidate.wall, was_near ? known->side : nearest.side});
  }
}

void Neighbours::remove_flagged(Reference& reference, const std::vector<char>& removed) {
  keep_unflagged(reference.x, removed);
  keep_unflagged(reference.y, removed);
}

void Neighbours::remove_wall(int wall) {
  broadphase_.remove_wall(wall);
  const auto is_of_it = [wall](const WallCandidate& candidate) { return candidate.wall == wall; };
  std::erase_if(wide_walls_, is_of_it);
  std::erase_if(narrow_walls_, is_of_it);
}

void Neighbours::remove_flagged(const std::vector<char>& removed) {
  if (!wide_is_valid_) return;
  std::vector<int> new_index(removed.size());
  int next = 0;
  for (std::size_t i = 0; i < removed.size(); ++i) new_index[i] = removed[i] ? -1 : next++;
  renumber(wide_, removed, new_index);
  renumber(narrow_, removed, new_index);
  if (period_ > 0) {
    renumber(wide_seam_, removed, new_index);
    renumber(narrow_seam_, removed, new_index);
  }
  renumber(wide_walls_, removed, new_index);
  renumber(narrow_walls_, removed, new_index);
  remove_flagged(wide_reference_, removed);
  remove_flagged(narrow_reference_, removed);
}

}  // namespace vibrosow
