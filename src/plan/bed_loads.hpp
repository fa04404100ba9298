#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

/// What a bed and its vessels do to the grains, predicted before any moves.
struct BedLoads {
  double layers;         // of the deepest fill, at least 1
  double weight_factor;  // weight of a grain in a vertically shaken vessel over its weight at rest
  /// Force over mass of a lot's smallest seed, against that of a seed of mean diameter in a bed of mean seeds: a
  /// fraction of the bed's pressure that goes with its diameter, over its own mass. 1 for single sizes.
  double load_of_smallest;
  double vessel_speed;  // m/s, the fastest of any vessel's wall
  double fall_speed;    // m/s, of seeds that rain, that drop from a hopper to the tray's floor, or through a hole
  double grain_speed;   // m/s, that a grain can reach: twice the vessel's, or the fall from the highest edge
};

/// `sizes`: by lot; `vessels`: the scene's, the tray first.
BedLoads bed_loads(const std::vector<SeedLot>& lots, const std::vector<SeedSizes>& sizes,
                   const std::vector<Vessel>& vessels, const RunPlan& run, Space space);

}  // namespace vibrosow
