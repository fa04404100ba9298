#pragma once

#include <vector>

#include "simulation/simulation.hpp"
#include "support/solid_lots.hpp"

namespace vibrosow {

/// A box of 1 m, or of another edge (m), with these clumps alone.
inline Scene clump_scene(const SeedLot& lot, double edge = 1) {
  Scene scene;
  scene.space = Space::three_dimensional;
  scene.lots = {lot};
  scene.contact.shell_compression = 1e-4;
  scene.tray.name = "tray";
  scene.tray.length = scene.tray.height = edge, scene.tray.depth = edge;
  scene.run.duration = 1;
  return scene;
}

struct PlacedClump {
  Eigen::Vector3d at, velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();  // m, m/s, rad/s
  Orientation orientation{};
};

inline SimulationState start_of(const Model& model, const std::vector<PlacedClump>& clumps) {
  Grains grains = no_grains(model);
  for (const PlacedClump& clump : clumps) {
    grains.add(clump.at, clump.velocity, 0, grains.kinds.front(), {0, of_unit_length(clump.orientation)});
    if (!grains.rotation) continue;
    grains.omega_x.back() = clump.spin.x(), grains.omega_y.back() = clump.spin.y();
    grains.omega.back() = clump.spin.z();
  }
  return starting_state(model, 1, std::move(grains));
}

}  // namespace vibrosow
