#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// Makes a lot's seeds clumps of these discs (m, anywhere), in 3D of balls: about their centre of mass, in 3D
/// along the principal axes, with their inertia and diameter. Mass and sizes stay.
void make_clump(SeedLot& lot, const std::vector<ClumpDisc>& discs, Space space);

}  // namespace vibrosow
