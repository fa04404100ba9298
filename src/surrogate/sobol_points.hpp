#pragma once

#include <Eigen/Core>

namespace vibrosow {

/// The first points of Sobol's sequence after its zero (Joe & Kuo's directions, from Boost.Random), one a row, inside
/// the unit cube. Throws std::invalid_argument for no dimension.
Eigen::MatrixXd sobol_points(Eigen::Index count, Eigen::Index dimensions);

}  // namespace vibrosow
