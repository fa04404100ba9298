#pragma once

#include <optional>
#include <vector>

#include "fields/packing_fraction.hpp"
#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A part of a bed along the floor, m; in 3D from front to back `depth` deep.
struct Stretch {
  double from, to;
  double depth = 0;
};

/// Rise over run of a bed's surface along x: the least-squares line through the highest points of the discs (balls) at
/// 64 evenly spaced places of the stretch, in 3D on 8 lines side by side; the floor, 0, where there is none.
double surface_slope(const std::vector<CoveringDisc>& discs, const Stretch& stretch);

/// Drained (emptying) angle of repose, rad: of the two heaps that stay against the end walls when a box has drained
/// through one hole in its floor. The mean of both heaps' angles, each of the `surface_slope` from `margin` (m) beyond
/// the hole's edge to `margin` before the wall; below 0 where they fall towards the walls. None: the tray has not one
/// hole, grains still lie over its middle half (it has clogged), or a heap is narrower than 4 margins. `own`: in the
/// tray's frame.
std::optional<double> drained_angle(const Snapshot& own, const std::vector<SeedLot>& lots, const Vessel& tray,
                                    double margin);

}  // namespace vibrosow
