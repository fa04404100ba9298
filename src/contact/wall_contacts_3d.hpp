#pragma once

#include <span>
#include <vector>

#include "contact/contact_list.hpp"
#include "contact/data_3d.hpp"
#include "contact/kernels.hpp"
#include "contact/over_plates.hpp"
#include "contact/wall_touches.hpp"
#include "grains/grains.hpp"
#include "loops/forces_3d.hpp"
#include "vessel/nearest_on_face.hpp"

namespace vibrosow {

/// Looks through the candidates for balls that touch faces; WallTouches says which of these push. Candidates lie sorted
/// by grain; ranges of them that part no grain's may be looked through side by side, each by a finder of its own.
class WallFinder3d {
 public:
  explicit WallFinder3d(InstructionSet instructions = InstructionSet::generic)
      : over_plates_(over_plates(instructions)) {}

  /// Sets `contacts`, whose candidates are numbered from `first`.
  void find(const Grains& grains, std::span<const WallCandidate> candidates, std::size_t first,
            const std::vector<PlacedFace>& faces, WallContacts3d& contacts);

  /// For the candidates of the last `find`: a side follows the ball while it is beyond the face's edges or over a hole;
  /// a change of side over the face is a crossing, noted in `crossed` (numbers of grains).
  void watch_crossings(std::span<WallCandidate> candidates, std::vector<int>& crossed) const;

  /// Of the last `find`.
  const WallTouches& touches() const { return touches_; }

 private:
  NearestOnFace nearest(const PlacedFace& face, const Eigen::Vector3d& centre, std::size_t candidate) const;

  OverPlates over_plates_;
  std::vector<PlateRows> plates_;       // by face
  std::vector<double> height_;          // m, by candidate of the range, over its plate
  std::vector<OverPlate> stands_;       // by candidate of the range
  std::vector<std::size_t> close_;      // candidates that are not clear of a plate's plane
  std::vector<NearestOnFace> nearest_;  // by candidate of the range, of those that are close
  std::vector<std::size_t> near_;       // candidates nearer than a radius
  WallTouches touches_;
};

/// Adds the forces of contacts to their balls, those of one ball added up among themselves first.
void add_wall_forces(const WallContacts3d& contacts, bool rotation, Forces3d& forces);

/// Adds what the walls do by their motion, W, contact by contact.
void add_wall_power(const WallContacts3d& contacts, double& power);

}  // namespace vibrosow
