#pragma once

#include <Eigen/Core>
#include <vector>

#include "vessel/directions.hpp"
#include "vessel/face.hpp"

namespace vibrosow {

/// A face where it stands now, in the lab frame.
struct PlacedFace {
  const Face* own = nullptr;               // what does not change: its kind, lengths and holes
  Eigen::Vector3d origin, e1, e2, normal;  // m; unit vectors
  /// How its material moves: at p at velocity + spin x p, m/s and rad/s.
  struct Moving {
    Eigen::Vector3d velocity, spin;
    Eigen::Vector3d at(const Eigen::Vector3d& p) const { return velocity + cross(spin, p); }
  };
  Moving now, on_mean;                    // when it stands here, and on the mean over the step that brought it here
  double sine_half = 0, cosine_half = 0;  // of a surface of revolution's half angle
};

}  // namespace vibrosow
