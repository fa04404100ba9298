#pragma once

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads [tray] or [hopper]; the origin is left at (0, 0). `lots` give the diameter that hole widths may be
/// counted in, and what has to fit; a hopper has the depth and the front and back of its `tray` unless it says
/// otherwise. Throws InputError like read_scene.
Vessel read_vessel(Table table, const std::string& name, const std::vector<SeedLot>& lots, Space space,
                   const Vessel* tray = nullptr);

}  // namespace vibrosow
