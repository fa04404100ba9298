#include "plan/bed_loads.hpp"

#include <algorithm>
#include <cmath>

#include "portable_math/functions.hpp"
#include "scene/spaces.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

double mean_diameter(const std::vector<SeedLot>& lots, const std::vector<SeedSizes>& sizes) {
  double mean = 0;
  for (std::size_t l = 0; l < lots.size(); ++l) mean += lots[l].number_fraction * sizes[l].mean * lots[l].diameter;
  return mean;
}

double seeds_of_a_layer(const Vessel& vessel, double diameter, Space space) {
  if (space == Space::two_dimensional) return vessel.length / diameter;
  return floor_area(vessel) / (diameter * diameter);
}

/// At most: all that rains while the run lasts stays, up to the vessel's height.
double seeds_of(const Vessel& vessel, double diameter, double duration, Space space) {
  const double filled = vessel.fill ? vessel.fill->count : 0;
  if (!vessel.rain) return filled;
  const double rained = vessel.rain->rate * std::max(0.0, std::min(vessel.rain->stop, duration) - vessel.rain->start);
  const double most = seeds_of_a_layer(vessel, diameter, space) * vessel.height / diameter;
  return std::max(filled, std::min(filled + rained, most));
}

double deepest_fill(const std::vector<Vessel>& vessels, double diameter, double duration, Space space) {
  double layers = 1;
  for (const Vessel& vessel : vessels)
    if (vessel.fill || vessel.rain)
      layers = std::max(
          layers, std::ceil(seeds_of(vessel, diameter, duration, space) / seeds_of_a_layer(vessel, diameter, space)));
  return layers;
}

double load_of_smallest(const std::vector<SeedLot>& lots, const std::vector<SeedSizes>& sizes) {
  double largest = 1;
  for (std::size_t l = 0; l < lots.size(); ++l) {
    const double pressed = portable_math::pow(sizes[l].least, mass_power(lots[l]) - 1);
    largest = std::max(largest, sizes[l].mean_mass / lots[l].mass / pressed);
  }
  return largest;
}

/// How far seeds fall freely before they meet others or a floor, m: rain, from its height; from a hopper with holes to
/// the tray's floor; and at a hole about its width, from the arch over it. What is poured lies still.
double free_fall(const std::vector<Vessel>& vessels) {
  double fall = 0;
  for (const Vessel& vessel : vessels) {
    if (vessel.rain) fall = std::max(fall, vessel.rain->height);
    for (const Hole& hole : vessel.holes)
      fall = std::max({fall, hole.width, vessel.origin.y() - vessels.front().origin.y()});
  }
  return fall;
}

/// From the highest edge, or place of rain, to the counting line, m.
double longest_fall(const std::vector<Vessel>& vessels, double count_below) {
  double drop = vessels.front().height;
  for (const Vessel& vessel : vessels) {
    drop = std::max(drop, vessel.origin.y() + vessel.height);
    if (vessel.rain) drop = std::max(drop, vessel.origin.y() + vessel.rain->height);
  }
  return drop + count_below;
}

}  // namespace

BedLoads bed_loads(const std::vector<SeedLot>& lots, const std::vector<SeedSizes>& sizes,
                   const std::vector<Vessel>& vessels, const RunPlan& run, Space space) {
  MotionBounds most;
  for (const Vessel& vessel : vessels) {
    const MotionBounds bounds = motion_bounds(vessel);
    most.speed = std::max(most.speed, bounds.speed);
    most.vertical_acceleration = std::max(most.vertical_acceleration, bounds.vertical_acceleration);
  }
  return {.layers = deepest_fill(vessels, mean_diameter(lots, sizes), run.duration, space),
          .weight_factor = 1 + most.vertical_acceleration / standard_gravity,
          .load_of_smallest = load_of_smallest(lots, sizes),
          .vessel_speed = most.speed,
          .fall_speed = std::sqrt(2 * standard_gravity * free_fall(vessels)),
          .grain_speed =
              std::max(2 * most.speed, std::sqrt(2 * standard_gravity * longest_fall(vessels, run.count_below)))};
}

}  // namespace vibrosow
