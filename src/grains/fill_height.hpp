#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// How many seeds fill a vessel up to `height` (m) above its level floor, at right angles to that, by the packing of
/// its fill, whose count counts for nothing. In rows: the places that lie wholly below. Poured: what the room below
/// takes, beneath no funnel and in no closed piece (`FreeRoom`), where seeds cover `poured_share` of it, in 3D fill
/// as much as poured seeds so long do; walls near each other leave a twentieth less. Holes are closed. Up to the walls'
/// height.
double seeds_to_height(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space, double height);

/// How high (m) a vessel's fill lies by that rule; not above the walls' height, where it may not fit.
double height_of_fill(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space);

/// How high (m) the seeds of a poured fill that lay level up to that height would lie, on the mean.
double mean_height_of_poured(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space);

}  // namespace vibrosow
