#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/drawing.hpp"
#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads [tray] or [hopper]; the origin is left at (0, 0). `lots` give the diameter that hole widths may be
/// counted in, and what has to fit; a hopper has the depth and the front and back of its `tray` unless it says
/// otherwise. `slice` (m) is given where the file counts seeds in the other space than `space`: the thickness of the
/// slice that the plane simulates, by which fill and rain are converted. What its drawings gave is added to `drawings`.
/// Throws InputError like read_scene.
Vessel read_vessel(Table table, const std::string& name, const std::vector<SeedLot>& lots, Space space,
                   std::vector<Drawing>& drawings, const Vessel* tray = nullptr,
                   std::optional<double> slice = std::nullopt);

}  // namespace vibrosow
