#pragma once

#include <vector>

#include "grains/orientation.hpp"
#include "scene/scene.hpp"
#include "vessel/pose.hpp"

namespace vibrosow {

/// The discs of a seed of `size` (of its lot's diameter) as it is turned, m from its centre; in 3D its balls. Of a
/// seed that is no clump, itself.
std::vector<ClumpDisc> turned_discs(const SeedLot& lot, double size, const Turn& turned);

/// How a seed that is turned so in its vessel's frame is turned in the lab.
Turn turn_in_lab(const Vessel& vessel, const Pose& pose, const Turn& own);

/// The one of a seed's discs whose centre is furthest within it: the largest, the first of several.
const ClumpDisc& thickest(const std::vector<ClumpDisc>& discs);

/// Half the least width of a seed of `size` (of its lot's diameter), m: the radius of its thickest disc, in 3D ball.
/// It passes no narrower gap, however it is turned.
double half_width(const SeedLot& lot, double size);

/// The same of the smallest seed there can be, and of the one of all that is widest so.
double least_half_width(const std::vector<SeedLot>& lots);
double most_half_width(const std::vector<SeedLot>& lots);

/// Diameter of the largest disc, in 3D ball, that there can be, alone or in a clump, m.
double largest_disc(const std::vector<SeedLot>& lots);

}  // namespace vibrosow
