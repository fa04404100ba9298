#pragma once

#include <Eigen/Core>

#include "elementary/functions.hpp"

namespace vibrosow {

/// Of length 1, at an angle (rad) from x to y.
inline Eigen::Vector2d unit_vector(double angle) {
  const auto [sine, cosine] = elementary::sine_cosine(angle);
  return {cosine, sine};
}

/// Turns a vector anticlockwise by `angle` (rad).
inline Eigen::Matrix2d rotation(double angle) {
  const auto [sine, cosine] = elementary::sine_cosine(angle);
  return Eigen::Matrix2d{{cosine, -sine}, {sine, cosine}};
}

/// a x b. (Eigen's own comes with rotations that take the C library's sine.)
inline Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

}  // namespace vibrosow
