#pragma once

#include <vector>

#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"

namespace vibrosow {

/// Clumps of these balls (m), from their centre of mass along their principal axes.
inline SeedLot solid_lot(const std::vector<ClumpDisc>& balls, double mass) {
  SeedLot lot{"clump", 0, mass, Shape::clump, 1};
  make_clump(lot, balls, Space::three_dimensional);
  return lot;
}

/// Four unlike balls, no two principal moments alike.
inline std::vector<ClumpDisc> odd_balls() {
  return {{0, 0, 5e-3}, {6e-3, 1e-3, 3e-3}, {-3e-3, 5e-3, 2e-3, 1e-3}, {0, 2e-3, 3e-3, 4e-3}};
}

/// Wheat as models/crops/wheat-grain.toml has it.
inline SeedLot wheat_grains() {
  return solid_lot(elongated_solid(6.32e-3, 2.92e-3, 2.66e-3), 29.6e-6);
}

}  // namespace vibrosow
