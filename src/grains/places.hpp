#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "grains/random.hpp"
#include "scene/scene.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// A place on the floor of a vessel in 3D, in its own frame: along (x) and across (z), m.
using FloorPlace = Eigen::Vector2d;

/// The nearest place to `place` where a ball of `radius` is between the vessel's ends; where these are periodic, the
/// same place within the period.
FloorPlace between_ends(const Vessel& vessel, double radius, const FloorPlace& place);

/// The same of a clump whose `balls` (m, from its centre) are held by a ball that fits into the vessel; in a round one
/// it is the nearest place on the way to the middle.
FloorPlace between_ends(const Vessel& vessel, const std::vector<ClumpDisc>& balls, const FloorPlace& place);

/// The same place within the period of periodic ends; of others the place itself.
FloorPlace within_period(const Vessel& vessel, const FloorPlace& place);

/// Uniformly at random where a ball of `radius` is between the vessel's ends.
FloorPlace random_place(const Vessel& vessel, double radius, Random& random);

/// The same of the strip of its floor between two places along it (m), both between its end walls.
FloorPlace random_place(const Vessel& vessel, double radius, double from, double to, Random& random);

/// Seeds come into a drum as if its upper half were not there; any other vessel is itself.
Vessel without_lid(Vessel vessel);

/// What stands in the way of seeds in a vessel beside its level floor and its upright walls: funnels and pieces, in the
/// vessel's own frame; in the plane z counts for nothing.
class Obstacles {
 public:
  Obstacles(const Vessel& vessel, Space space);

  bool none() const { return segments_.empty() && faces_.empty(); }

  /// m, from a centre to the nearest of them; infinite where there are none.
  double distance(const Eigen::Vector3d& centre) const;

  /// m, a height that none of them reaches beyond; 0 where there are none.
  double top() const;

  /// Height of the centre of a ball that falls from `from` at `place` when it first touches one, at least `least`; it
  /// may stop a thousandth of its radius short. Infinite where it would begin inside one.
  double touching_height(const FloorPlace& place, double radius, double from, double least) const;

 private:
  std::vector<WallSegment> segments_;     // in 2D
  std::optional<Walls> pieces_, funnel_;  // in 3D
  std::vector<const PlacedFace*> faces_;
};

}  // namespace vibrosow
