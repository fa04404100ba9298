#pragma once

#include <Eigen/Core>

#include "loops/orientation.hpp"

namespace vibrosow {

/// How a clump is turned: by an angle (rad) in 2D, as it lies in 3D.
struct Turn {
  double angle = 0;
  Orientation orientation{};
};

/// Its columns are the clump's axes in the lab.
inline Eigen::Matrix3d rotation_matrix(const Orientation& q) {
  const Axes axes = axes_of(q);
  return Eigen::Matrix3d{
      {axes.x.x, axes.y.x, axes.z.x}, {axes.x.y, axes.y.y, axes.z.y}, {axes.x.z, axes.y.z, axes.z.z}};
}

}  // namespace vibrosow
