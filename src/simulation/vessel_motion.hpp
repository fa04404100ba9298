#pragma once

#include <Eigen/Core>

#include "scene/scene.hpp"

namespace vibrosow {

/// Displacement (m, lab) of a vessel from rest at `time` (s): A s(t) sin(2 pi f t) along the motion's direction, with
/// s = 3 (t/T)^2 - 2 (t/T)^3 during a ramp T. Zero without motion.
Eigen::Vector2d vessel_displacement(const Vessel& vessel, double time);

/// Its time derivative, m/s.
Eigen::Vector2d vessel_velocity(const Vessel& vessel, double time);

/// Largest acceleration of the motion, A (2 pi f)^2 in m/s2; 0 without motion.
double largest_acceleration(const Vessel& vessel);

/// Largest speed of the motion, 2 pi f A in m/s; 0 without motion.
double largest_speed(const Vessel& vessel);

}  // namespace vibrosow
