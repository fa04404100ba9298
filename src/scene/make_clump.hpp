#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// Makes a lot's seeds clumps of these discs (m, anywhere), in space of balls: about their centre of mass, in space
/// along the principal axes, with their inertia and diameter. Mass and sizes stay.
void make_clump(SeedLot& lot, const std::vector<ClumpDisc>& discs, Space space);

}  // namespace vibrosow
