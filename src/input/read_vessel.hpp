#pragma once

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads [tray] or [hopper]; the origin is left at (0, 0). `lots` give the diameter that hole widths may be
/// counted in, and what has to fit. Throws InputError like read_scene.
Vessel read_vessel(Table table, const std::string& name, const std::vector<SeedLot>& lots);

/// m; `lots` is not empty.
double largest_mean_diameter(const std::vector<SeedLot>& lots);

/// `value`, which `key` has, in m: a length such as "16 mm", or "3 diameters" of `diameter`. Throws InputError at
/// `key` when it is neither, or not from 1e-6 m to 100 m.
double read_width(const Table& table, const std::string& key, const TomlValue& value, double diameter);

}  // namespace vibrosow
