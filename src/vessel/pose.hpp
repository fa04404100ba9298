#pragma once

#include <Eigen/Core>

namespace vibrosow {

/// Where a vessel stands against its place at rest: a point `own` of its frame lies at origin + displacement +
/// R(tilt + angle) own in the lab. In 3D it is first turned about its own upright axis by `turn`.
struct Pose {
  Eigen::Vector2d displacement = Eigen::Vector2d::Zero();  // m, lab, of the frame's zero
  double angle = 0;                                        // rad, anticlockwise, beside the tilt
  double across = 0;                                       // m, displacement in 3D, from front to back
  double turn = 0;                                         // rad, x towards z
};

/// The time derivative of a pose.
struct PoseRate {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s, lab, of the frame's zero
  double angular_velocity = 0;                         // rad/s
  double across_velocity = 0;                          // m/s
  double turn_rate = 0;                                // rad/s
};

}  // namespace vibrosow
