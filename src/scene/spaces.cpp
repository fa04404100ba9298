#include "scene/spaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

/// Of the lot alone: its thickness at its diameter, where masses go with a power above that of areas larger seeds count
/// for more.
double slice_of_lot(const SeedLot& lot) {
  const double thickness = mean_thickness(lot) / size_moment(lot, 1);
  return thickness * (size_moment(lot, mass_power(lot)) / size_moment(lot, 2));
}

/// Mean area, m2, that a lot's seeds take of a slice.
double mean_section(const SeedLot& lot) {
  const double area =
      lot.shape == Shape::clump ? plate_of(lot.discs).area : std::numbers::pi / 4 * lot.diameter * lot.diameter;
  return area * size_moment(lot, 2);
}

void cut(Vessel& vessel, double thickness) {
  multiply_seeds(vessel, 1 / slices_of_vessel(vessel, thickness));
  std::vector<Hole> row;
  for (Hole hole : vessel.holes) {
    hole.shape = HoleShape::slot, hole.across = hole.across_length = 0;
    if (row.empty() || hole.centre > row.back().centre) row.push_back(hole);
  }
  vessel.holes = row;
  vessel.plan = Plan::rectangle, vessel.front_and_back = Sides::walls, vessel.front = 0;
}

/// Clumps of balls become those of the discs that are their sections.
void change_clumps(Scene& scene) {
  for (SeedLot& lot : scene.lots) {
    if (lot.shape != Shape::clump) continue;
    const double diameter = lot.diameter;
    make_clump(lot, lot.discs, scene.space);
    scale(lot.sizes, lot.diameter / diameter);
  }
}

}  // namespace

double slice_thickness(const std::vector<SeedLot>& lots) {
  if (lots.size() == 1) return slice_of_lot(lots.front());
  double volume = 0, area = 0;
  for (const SeedLot& lot : lots) {
    const double section = lot.number_fraction * mean_section(lot);
    area += section;
    volume += section * slice_of_lot(lot);
  }
  return volume / area;
}

double mean_area(const std::vector<SeedLot>& lots) {
  double area = 0;
  for (const SeedLot& lot : lots) area += lot.number_fraction * mean_section(lot);
  return area;
}

double mean_volume(const std::vector<SeedLot>& lots) {
  double volume = 0;
  for (const SeedLot& lot : lots) {
    const double ball = std::numbers::pi / 6 * lot.diameter * lot.diameter * lot.diameter;
    volume += lot.number_fraction * size_moment(lot, 3) * (lot.shape == Shape::clump ? clump_volume(lot) : ball);
  }
  return volume;
}

double implied_bulk_density(const std::vector<SeedLot>& lots, double filled) {
  double mass = 0, area = 0;
  for (const SeedLot& lot : lots) {
    mass += lot.number_fraction * mean_mass(lot);
    area += lot.number_fraction * mean_section(lot);
  }
  return filled * mass / (area * slice_thickness(lots));
}

std::optional<double> solid_density(const std::vector<SeedLot>& lots) {
  double mass = 0, volume = 0;
  for (const SeedLot& lot : lots) {
    const auto density = seed_density(lot);
    if (!density) return std::nullopt;
    mass += lot.number_fraction * mean_mass(lot);
    volume += lot.number_fraction * mean_mass(lot) / *density;
  }
  return mass / volume;
}

double slices_of_vessel(const Vessel& vessel, double thickness) {
  return floor_area(vessel) / (vessel.length * thickness);
}

void multiply_seeds(Vessel& vessel, double times) {
  constexpr double most = 2e9;
  if (vessel.fill) vessel.fill->count = static_cast<int>(std::clamp(std::round(vessel.fill->count * times), 1.0, most));
  if (vessel.rain) vessel.rain->rate *= times;
}

double floor_area(const Vessel& vessel) {
  const double part = vessel.plan == Plan::round ? std::numbers::pi / 4 : 1;
  return part * vessel.length * *vessel.depth;
}

std::optional<double> slices_of_tray(const Scene& scene) {
  if (!scene.tray.depth) return std::nullopt;
  return *scene.tray.depth / slice_thickness(scene.lots);
}

Scene in_plane(Scene scene) {
  if (scene.space == Space::two_dimensional) return scene;
  scene.space = Space::two_dimensional;
  const double thickness = slice_thickness(scene.lots);
  change_clumps(scene);
  cut(scene.tray, thickness);
  if (scene.hopper) cut(*scene.hopper, thickness);
  return scene;
}

}  // namespace vibrosow
