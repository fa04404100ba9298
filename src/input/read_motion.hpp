#pragma once

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads [tray.motion] or [hopper.motion]. Throws InputError like read_scene, and for a table of positions with the
/// CSV file's own line and column.
VesselMotion read_motion(Table table);

/// Reads positions over time from a CSV file: columns time_s and at least one of x_mm, y_mm and angle_degree, four rows
/// or more, times ascending. Columns left out are zero. Throws InputError.
TableMotion read_motion_table(const CsvLines& csv);

}  // namespace vibrosow
