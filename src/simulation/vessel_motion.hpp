#pragma once

#include <Eigen/Core>

#include "scene/pose.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Pose of a vessel at `time` (s): its frame moves by A s(t) sin(2 pi f t) along the motion's direction, with
/// s = 3 (t/T)^2 - 2 (t/T)^3 during a ramp T. At rest without motion.
Pose vessel_pose(const Vessel& vessel, double time);

/// Its time derivative.
PoseRate vessel_velocity(const Vessel& vessel, double time);

/// A point of the vessel's own frame in the lab, and the inverse. Frames in m.
Eigen::Vector2d in_lab_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& own);
Eigen::Vector2d in_vessel_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& lab);

/// Velocity (m/s, lab) of the vessel's material at the point `lab` (m).
Eigen::Vector2d material_velocity(const Vessel& vessel, const Pose& pose, const PoseRate& rate,
                                  const Eigen::Vector2d& lab);

/// Largest acceleration of the motion, A (2 pi f)^2 in m/s2; 0 without motion.
double largest_acceleration(const Vessel& vessel);

/// Largest speed of the motion, 2 pi f A in m/s; 0 without motion.
double largest_speed(const Vessel& vessel);

}  // namespace vibrosow
