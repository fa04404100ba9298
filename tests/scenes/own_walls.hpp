#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// A wall as this test sees it, made from the scene's numbers alone, and not by what the program makes of them.
struct OwnWall {
  std::string name;
  double opens_at = 0;                                     // s, of a gate
  std::function<double(const Eigen::Vector3d&)> distance;  // m, from a point of the vessel's frame; z is 0 in 2D
};

/// Floor, ends, funnel, pieces and gates, where a vessel is periodic with those beside it.
std::vector<OwnWall> own_walls(const Vessel& vessel, Space space);

/// Lids over all holes, as while a vessel is filled.
std::vector<OwnWall> own_lids(const Vessel& vessel, Space space);

/// Which places of a vessel's frame can be reached from its open top without passing a wall, its holes closed; in a
/// drum those within its circle. A point is what goes there: a gap that is narrower than a seed is no obstacle.
class OwnRoom {
 public:
  /// `fine` (m): how far the places that are looked at lie apart.
  OwnRoom(const Vessel& vessel, Space space, double fine);

  /// Of a centre (m): whether it is between the ends and, up to the walls' top, reached.
  bool contains(Eigen::Vector3d centre) const;

 private:
  bool is_between_ends(const Eigen::Vector3d& centre) const;
  std::size_t index(int i, int j, int k) const;
  Eigen::Vector3d place(int i, int j, int k) const {
    return fine_ * Eigen::Vector3d(i + 0.5, j + 0.5, deep_ ? k + 0.5 : 0);
  }
  void flood(const std::vector<OwnWall>& walls);

  Vessel vessel_;
  bool deep_;
  double fine_;                // m
  int along_, up_, across_;    // places
  std::vector<char> reached_;  // empty: the room is the box
};

}  // namespace vibrosow
