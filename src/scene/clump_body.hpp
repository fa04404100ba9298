#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// A uniform body in the shape of the union of balls; where they overlap, the body is there once.
struct Body {
  double volume;           // m3
  Eigen::Vector3d centre;  // m, of mass
  Eigen::Matrix3d spread;  // m2, mean of (r - centre)(r - centre)^T
};

/// Of balls on one line, as two are always, exact: between places where another ball becomes the widest, powers of x
/// and of r^2 - (x - c)^2 are integrated in closed form. Of others by sections across z, exact by Green's theorem along
/// the arcs that no other disc covers, and Gauss' rule over the height between all places where the sections' pattern
/// changes: to 1e-10 of volume and spread. The balls, at least one and of positive radius, may be apart, contain one
/// another or be equal.
Body body_of_balls(const std::vector<ClumpDisc>& balls);

/// The same of a row parallel to x.
struct RowBody {
  double volume;         // m3
  double centre;         // m, along x
  double along, across;  // m2, mean of (x - centre)^2, and of the distance from the axis squared over 2
};
RowBody row_body(const std::vector<ClumpDisc>& row);

/// A clump of balls from its centre of mass along its principal axes, which are the given ones turned as little as the
/// diagonalisation by Jacobi's rotations does; a row comes to lie along x.
struct SolidClump {
  std::vector<ClumpDisc> balls;
  Eigen::Vector3d gyration2;  // m2, moment of inertia over mass about x, y and z
};
SolidClump solid_clump(const std::vector<ClumpDisc>& balls);

}  // namespace vibrosow
