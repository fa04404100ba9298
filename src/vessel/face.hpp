#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace vibrosow {

/// A round hole in a plate, in the plate's own coordinates.
struct RoundHole {
  double u = 0, v = 0;  // m
  double radius = 0;    // m
  bool operator==(const RoundHole&) const = default;
};

/// A piece of a vessel's wall in 3D, in a frame of its own: `origin` and three unit vectors at right angles, e1 x e2
/// = normal. A plate lies where u is in [0, length_u] along e1 and v in [0, length_v] along e2, or where it is round in
/// the circle that these lengths hold, but for its holes, which do not meet its edges or each other. A surface of
/// revolution is a straight line from (radius_a, height_a) to (radius_b, height_b), distance from the axis and height
/// along it, turned about the axis through `origin` along `normal` by `half_angle` to either side of e1: a cylinder, a
/// cone, a disc or a ring.
struct Face {
  enum class Kind { plate, revolved };
  Kind kind = Kind::plate;
  std::string name;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d e1 = Eigen::Vector3d::UnitX(), e2 = Eigen::Vector3d::UnitY(), normal = Eigen::Vector3d::UnitZ();
  double length_u = 0, length_v = 0;  // m
  bool round = false;                 // of a plate as long as wide
  std::vector<RoundHole> holes{};
  double radius_a = 0, height_a = 0, radius_b = 0, height_b = 0;  // m
  double half_angle = 0;                                          // rad, pi: all round
  double opens_at = 0;                                            // s, of a gate; 0: none
};

}  // namespace vibrosow
