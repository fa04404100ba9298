#pragma once

#include <Eigen/Core>

#include "portable_math/functions.hpp"
#include "scene/cross_product.hpp"

namespace vibrosow {

/// Of length 1, at an angle (rad) from x to y.
inline Eigen::Vector2d unit_vector(double angle) {
  const auto [sine, cosine] = portable_math::sine_cosine(angle);
  return {cosine, sine};
}

/// Turns a vector anticlockwise by `angle` (rad).
inline Eigen::Matrix2d rotation(double angle) {
  const auto [sine, cosine] = portable_math::sine_cosine(angle);
  return Eigen::Matrix2d{{cosine, -sine}, {sine, cosine}};
}

}  // namespace vibrosow
