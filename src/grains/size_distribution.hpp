#pragma once

#include <vector>

#include "grains/grains.hpp"
#include "grains/random.hpp"

namespace vibrosow {

/// Size of a seed of a lot, as a multiple of its diameter, within its least and most: the distribution's quantile of
/// one uniform number. A single size is 1, and draws nothing.
double draw_size(const SeedLot& lot, Random& random);

/// How a seed is turned, rad in [0, 2 pi): at random for a clump; 0 for others, which draw nothing.
double draw_angle(const SeedLot& lot, Random& random);

/// Any way to lie in 3D is as likely as any other: by three numbers (Shoemake, Graphics Gems III, 1992).
Orientation draw_orientation(Random& random);

/// How a seed is turned: a clump in 2D by its angle, in 3D by its orientation; others draw nothing.
Turn draw_turn(const SeedLot& lot, Random& random);

}  // namespace vibrosow
