#pragma once

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads [tray.holes] or [hopper.holes] for a vessel whose lengths and plan are known; widths may be counted in
/// `diameter` (m). In 2D a row of holes stands for all rows, and of a round hole the shape alone is kept. From
/// the left, of one centre from the front. Throws InputError like read_scene.
std::vector<Hole> read_holes(Table table, const Vessel& vessel, Space space, double diameter);

/// Of the same table of a vessel in 2D whose depth is known. Throws InputError like read_scene.
SlotsIn3d read_slots_in_3d(Table table, HoleShape shape, double depth);

}  // namespace vibrosow
