#pragma once

#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// The normal distribution behind a normal (of the diameter, m) or a lognormal (of ln(diameter / m)) one. A
/// lognormal's mean m and deviation s are of the diameter itself: sigma^2 = ln(1 + (s / m)^2), mu = ln m - sigma^2 / 2.
struct UnderlyingNormal {
  double mean, deviation;
};
UnderlyingNormal underlying_normal(const SizeDistribution& sizes);

/// Makes all its diameters `factor` times what they are.
void scale(SizeDistribution& sizes, double factor);

/// Smallest and largest size of a lot's seeds, and E[size^power] by number, all in multiples of `lot.diameter`; exactly
/// 1 for a single size. `power` 1 to 3. Of normal and lognormal by Gauss-Kronrod quadrature, to 1e-12.
double least_size(const SeedLot& lot);
double most_size(const SeedLot& lot);
double size_moment(const SeedLot& lot, int power);

/// Whether a lot's seeds are clumps of balls in 3D.
bool is_solid_clump(const SeedLot& lot);

bool has_clumps(const std::vector<SeedLot>& lots);

/// The power of its size with which a seed's mass grows, at equal density: 3, as of every real seed, be it simulated in
/// the plane; 2 of a disc alone, which has no thickness.
int mass_power(const SeedLot& lot);

/// Mean mass of a lot's seeds, kg: m E[size^mass_power].
double mean_mass(const SeedLot& lot);

/// The above, of a lot.
struct SeedSizes {
  double least, most, mean;  // in multiples of the lot's diameter
  double mean_mass;          // kg
};
std::vector<SeedSizes> sizes_of(const std::vector<SeedLot>& lots);

/// Volume of a clump of a lot's diameter, m3: of its balls, in 2D as if its discs were balls.
double clump_volume(const SeedLot& lot);

/// Density of a seed, kg/m3; of a clump by `clump_volume`; none of a disc, which has no thickness.
std::optional<double> seed_density(const SeedLot& lot);

/// Mean diameter of a lot's seeds across the plane, m: of a clump that of its largest disc, as if it were round about
/// its long axis.
double mean_thickness(const SeedLot& lot);

/// Diameter of the largest seed there can be, m; of a clump: of the circle that holds it.
double largest_diameter(const std::vector<SeedLot>& lots);

/// The same of the largest disc or ball of any seed, m.
double largest_disc_diameter(const std::vector<SeedLot>& lots);

/// Radius of the smallest seed there can be, m; of a clump: of its smallest disc.
double smallest_radius(const std::vector<SeedLot>& lots);

}  // namespace vibrosow
