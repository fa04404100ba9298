#pragma once

#include <span>
#include <vector>

#include "contact/contact_list.hpp"
#include "contact/kernels.hpp"
#include "contact/wall_touches.hpp"
#include "vessel/nearest_point.hpp"
#include "vessel/placed_wall.hpp"

namespace vibrosow {

/// Looks through the candidates for grains that touch walls; WallTouches says which of these push. Candidates lie
/// sorted by grain; ranges of them that part no grain's may be looked through side by side, each by a finder of its
/// own.
class WallContactFinder {
 public:
  /// Sets `contacts`, whose candidates are numbered from `first`.
  void find(const Grains& grains, std::span<const WallCandidate> candidates, std::size_t first,
            const std::vector<PlacedWall>& walls, WallContacts& contacts);

  /// For the candidates of the last `find`: a side follows the grain while it is beyond the wall's ends; a change of
  /// side beside the wall is a crossing, noted in `crossed` (numbers of grains).
  void watch_crossings(std::span<WallCandidate> candidates, std::vector<int>& crossed) const;

  /// Of the last `find`.
  const WallTouches& touches() const { return touches_; }

 private:
  std::vector<NearestPoint> nearest_;  // by candidate of the range
  std::vector<std::size_t> near_;      // candidates nearer than a radius; places to spare
  WallTouches touches_;
};

/// Adds the forces of contacts to their grains, those of one grain added up among themselves first, so that two walls
/// add up alike in either order.
void add_wall_forces(const WallContacts& contacts, bool rotation, Forces& forces);

/// Adds what the walls do by their motion, W, contact by contact.
void add_wall_power(const WallContacts& contacts, double& power);

}  // namespace vibrosow
