#pragma once

#include <vector>

#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"
#include "contact/kernels.hpp"
#include "vessel/nearest_point.hpp"
#include "vessel/placed_wall.hpp"

namespace vibrosow {

/// Looks through the candidates for grains that touch walls. A grain that touches a wall's face and an end point of the
/// same wall is pushed by the face alone, and once by an end point that two walls share.
class WallContactFinder {
 public:
  /// Sets `contacts`; `candidates` sorted by grain.
  void find(const Grains& grains, const std::vector<WallCandidate>& candidates, const std::vector<PlacedWall>& walls,
            WallContacts& contacts);

  /// For the candidates of the last `find`: a side follows the grain while it is beyond the wall's ends; a change of
  /// side beside the wall is a crossing, noted in `crossed` (numbers of grains).
  void watch_crossings(std::vector<WallCandidate>& candidates, std::vector<int>& crossed) const;

  /// Candidates of the last `find` that touched before and do not now have no history.
  void clear_parted(ContactHistories& histories) const;

 private:
  template <class Touch>
  void touch_each_point_once(const std::vector<WallCandidate>& candidates, const std::vector<PlacedWall>& walls,
                             std::size_t from, std::size_t to, Touch touch);

  std::vector<NearestPoint> nearest_;   // by candidate
  std::vector<unsigned char> touches_;  // by candidate
  std::vector<std::size_t> near_;       // candidates nearer than a radius; places to spare
  std::vector<int> covered_;            // end points of one grain
};

/// Adds the forces of contacts to their grains, those of one grain added up among themselves first, so that two walls
/// add up alike in either order; and what the walls do by their motion.
void add_wall_forces(const WallContacts& contacts, bool rotation, Forces& forces, ContactStatistics& statistics);

}  // namespace vibrosow
