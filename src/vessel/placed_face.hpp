#pragma once

#include <Eigen/Core>
#include <vector>

#include "vessel/face.hpp"

namespace vibrosow {

/// A face where it stands now, in the lab frame.
struct PlacedFace {
  const Face* own = nullptr;               // what does not change: its kind, lengths and holes
  Eigen::Vector3d origin, e1, e2, normal;  // m; unit vectors
  Eigen::Vector3d velocity, spin;  // m/s of its material at the lab's zero, rad/s: at p it moves at velocity + spin x p
  double sine_half = 0, cosine_half = 0;  // of a surface of revolution's half angle
};

}  // namespace vibrosow
