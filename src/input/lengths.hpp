#pragma once

#include <string>
#include <vector>

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

inline constexpr double shortest = 1e-6, longest = 100;  // m, of any length in a vessel

/// "12.5 mm" of a length in m, for messages.
std::string millimetres(double length);

/// To the picometre, so that the same places from other keys are the same numbers: 25 cm + 9 cm is 34 cm.
double rounded(double length);

/// m; `lots` is not empty.
double largest_mean_diameter(const std::vector<SeedLot>& lots);

/// `value`, which `key` has, in m: a length such as "16 mm", or "3 diameters" of `diameter`. Throws InputError at
/// `key` when it is neither, or not from 1e-6 m to 100 m.
double read_width(const Table& table, const std::string& key, const TomlValue& value, double diameter);

}  // namespace vibrosow
