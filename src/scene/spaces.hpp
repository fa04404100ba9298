#pragma once

#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// Area of a vessel's floor in 3D, m2, holes included. The vessel has a depth.
double floor_area(const Vessel& vessel);

/// Thickness (m) of the slice that the plane simulates: one seed. The bed that stands for a slice of that thickness
/// holds as much of it as a bed of one size does. A seed of lot i takes the area A_i of the slice and, alone, a slice
/// of its own thickness t_i; seeds that fill the same share of their area stand for the volume sum(n_i A_i t_i) over
/// the area sum(n_i A_i), by number n_i, so the slice is sum(n A t) / sum(n A) thick. Of balls that is sum(n d^3) /
/// sum(n d^2), the Sauter mean diameter (J. Sauter, VDI-Forschungsheft 279, 1926), within a lot of many sizes too; of a
/// single size just its own thickness (`mean_thickness`). By number alone a pea among clover would count as one seed of
/// a thousand.
double slice_thickness(const std::vector<SeedLot>& lots);

/// Share of its area that a bed of discs poured at random covers (Visscher & Bolsterli 1972, doi 10.1038/239504a0).
inline constexpr double poured_share = 0.82;

/// Mean area (m2) of a seed in 2D, of all lots by their fractions of the number.
double mean_area(const std::vector<SeedLot>& lots);

/// Mean volume (m3) of a seed in 3D, of all lots by their fractions of the number.
double mean_volume(const std::vector<SeedLot>& lots);

/// Bulk density (kg/m3) of the bed that the plane's slice stands for, where seeds cover the share `filled` of its area.
double implied_bulk_density(const std::vector<SeedLot>& lots, double filled);

/// Density (kg/m3) of the seeds themselves, all lots together; none where a lot is of discs, which have no volume.
std::optional<double> solid_density(const std::vector<SeedLot>& lots);

/// How many slices so thick (m) a tray holds: its depth over `slice_thickness`; none without a depth.
std::optional<double> slices_of_tray(const Scene& scene);

/// How many slices (m) through its middle a vessel with a depth holds: of a round one that is less than its diameter's
/// share, since the middle slice is the longest.
double slices_of_vessel(const Vessel& vessel, double thickness);

/// `times` as many seeds of its fill, at least one, and of its rain.
void multiply_seeds(Vessel& vessel, double times);

/// The slice of a scene in 3D that the plane simulates, for pictures of it: seeds and rain in its share, each row of
/// holes as slots from front to back, round vessels cut through their middle, clumps as their sections across z. A
/// scene of the plane stays as it is. To run both, read both: `read_in_both_spaces`.
Scene in_plane(Scene scene);

}  // namespace vibrosow
