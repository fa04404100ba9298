#pragma once

#include <vector>

#include "compute/execution.hpp"
#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"
#include "contact/kernels.hpp"
#include "contact/space_data.hpp"
#include "grains/grains.hpp"
#include "vessel/nearest_on_face.hpp"

namespace vibrosow {

/// Looks through the candidates for balls that touch faces. A ball is pushed by every face whose inside it touches, and
/// by an edge, a rim or a corner only where that point is on no face that pushes it already, and once where several
/// faces share it.
class SpaceWallFinder {
 public:
  /// Sets `contacts`; `candidates` sorted by grain.
  void find(const Grains& grains, const std::vector<WallCandidate>& candidates, const std::vector<PlacedFace>& faces,
            Execution& execution, SpaceWallContacts& contacts);

  /// For the candidates of the last `find`: a side follows the ball while it is beyond the face's edges or over a hole;
  /// a change of side over the face is a crossing, noted in `crossed` (numbers of grains).
  void watch_crossings(std::vector<WallCandidate>& candidates, std::vector<int>& crossed) const;

  /// Candidates of the last `find` that touched before and do not now have no history.
  void clear_parted(ContactHistories& histories) const;

 private:
  template <class Touch>
  void touch_each_point_once(const std::vector<PlacedFace>& faces, const std::vector<WallCandidate>& candidates,
                             const Eigen::Vector3d& centre, double radius, std::size_t from, std::size_t to,
                             Touch touch);

  std::vector<NearestOnFace> nearest_;  // by candidate
  std::vector<unsigned char> touches_;  // by candidate
  std::vector<std::size_t> near_;       // candidates nearer than a radius; places to spare
  std::vector<std::size_t> pushing_;    // candidates of one ball that push it
};

/// Adds the forces of contacts to their balls, those of one ball added up among themselves first; and what the walls do
/// by their motion.
void add_wall_forces(const SpaceWallContacts& contacts, bool rotation, std::vector<GrainVector>& forces,
                     std::vector<GrainVector>& torques, ContactStatistics& statistics);

}  // namespace vibrosow
