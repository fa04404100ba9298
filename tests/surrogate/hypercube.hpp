#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "study/latin_hypercube.hpp"

namespace vibrosow {

/// A Latin hypercube, one point a row.
inline Eigen::MatrixXd hypercube(Eigen::Index count, Eigen::Index dimensions, std::uint64_t random_seed) {
  const auto cube = latin_hypercube(static_cast<std::size_t>(count), static_cast<std::size_t>(dimensions), random_seed);
  Eigen::MatrixXd points(count, dimensions);
  for (std::size_t i = 0; i < cube.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::RowVectorXd>(cube[i].data(), dimensions);
  return points;
}

}  // namespace vibrosow
