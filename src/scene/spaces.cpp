#include "scene/spaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/input_error.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

double mean_thickness_of_seeds(const Scene& scene) {
  double thickness = 0;
  for (const SeedLot& lot : scene.lots) thickness += lot.number_fraction * mean_thickness(lot);
  return thickness;
}

/// `times` as many seeds.
void multiply_seeds(Vessel& vessel, double times) {
  if (vessel.fill) vessel.fill->count = std::max(1, static_cast<int>(std::lround(vessel.fill->count * times)));
  if (vessel.rain) vessel.rain->rate *= times;
}

void cut(Vessel& vessel, double thickness) {
  // The middle slice of a round vessel holds more than the mean one.
  const double share = vessel.plan == Plan::round ? 4 / std::numbers::pi : 1;
  multiply_seeds(vessel, share * thickness / *vessel.depth);
  std::vector<Hole> row;
  for (Hole hole : vessel.holes) {
    hole.shape = HoleShape::slot, hole.across = hole.across_length = 0;
    if (row.empty() || hole.centre > row.back().centre) row.push_back(hole);
  }
  vessel.holes = row;
  vessel.plan = Plan::rectangle, vessel.front_and_back = Sides::walls, vessel.front = 0;
}

void draw_out(Vessel& vessel, double depth, double thickness) {
  if (!vessel.depth) vessel.depth = depth;
  multiply_seeds(vessel, *vessel.depth / thickness);
  for (Hole& hole : vessel.holes)
    hole.shape = HoleShape::slot, hole.across = 0.5 * *vessel.depth, hole.across_length = *vessel.depth;
}

/// Clumps of discs become the clumps of balls with them as sections, and the other way round.
void change_clumps(Scene& scene) {
  for (SeedLot& lot : scene.lots) {
    if (lot.shape != Shape::clump) continue;
    const double diameter = lot.diameter;
    make_clump(lot, lot.discs, scene.space);
    scale(lot.sizes, lot.diameter / diameter);
  }
}

}  // namespace

double floor_area(const Vessel& vessel) {
  const double part = vessel.plan == Plan::round ? std::numbers::pi / 4 : 1;
  return part * vessel.length * *vessel.depth;
}

std::optional<double> slices_of_tray(const Scene& scene) {
  if (!scene.tray.depth) return std::nullopt;
  return *scene.tray.depth / mean_thickness_of_seeds(scene);
}

Scene in_plane(Scene scene) {
  if (scene.space == Space::plane) return scene;
  scene.space = Space::plane;
  const double thickness = mean_thickness_of_seeds(scene);
  change_clumps(scene);
  cut(scene.tray, thickness);
  if (scene.hopper) cut(*scene.hopper, thickness);
  return scene;
}

Scene in_space(Scene scene) {
  if (scene.space == Space::three_dimensional) return scene;
  if (!scene.tray.depth) throw InputError("tray.depth: is missing; in space a tray has a depth, from front to back");
  scene.space = Space::three_dimensional;
  const double thickness = mean_thickness_of_seeds(scene), depth = *scene.tray.depth;
  change_clumps(scene);
  draw_out(scene.tray, depth, thickness);
  if (scene.hopper) draw_out(*scene.hopper, depth, thickness);
  return scene;
}

}  // namespace vibrosow
