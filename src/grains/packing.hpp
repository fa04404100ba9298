#pragma once

#include <vector>

#include "compute/stop_request.hpp"
#include "grains/orientation.hpp"
#include "grains/random.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

struct PackedGrain {
  double x, y;  // m, in the vessel's frame
  int lot;
  double size = 1;  // of the lot's diameter
  Turn turned{};    // of a clump
  double z = 0;     // m, in 3D
};

/// Places the vessel's fill at rest without overlap, its holes closed. `poured`: each grain drops at a random place and
/// rolls down to where two contacts hold it (drop-and-roll: Visscher & Bolsterli 1972, in 2D); a clump lies
/// where, of many drops near its first, its centre comes lowest, its discs touching. `layers` and `hexagonal`: rows,
/// each grain shifted at random by up to the jitter, a clump in the circle, in 3D the ball, that holds it. In 3D
/// see `pour_3d`, and layers are square: one above the other, or as `hexagonal` closest packed. Lots are mixed at
/// random in exact fractions (largest remainder), sizes and how clumps are turned are drawn. No fill: empty. Throws
/// InputError when the packing rises above the vessel's end walls, Interrupted where `stop` is set.
std::vector<PackedGrain> pack(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space, Random& random,
                              StopRequest stop = {});

}  // namespace vibrosow
