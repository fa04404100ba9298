#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace vibrosow {

/// Points of the unit cube, one a row: along each dimension one in each of `count` equal intervals, at random within it
/// (McKay, Beckman & Conover 1979). Of 50 such sets drawn, the one whose nearest two points lie farthest apart
/// (Johnson, Moore & Ylvisaker 1990).
Eigen::MatrixXd latin_hypercube(Eigen::Index count, Eigen::Index dimensions, std::uint64_t random_seed);

/// The first points of Sobol's sequence after its zero (Joe & Kuo's directions, from Boost.Random), one a row, inside
/// the unit cube. Throws std::invalid_argument for no dimension.
Eigen::MatrixXd sobol_points(Eigen::Index count, Eigen::Index dimensions);

}  // namespace vibrosow
