#pragma once

#include "agronomy/drill.hpp"
#include "input/table.hpp"

namespace vibrosow {

/// Reads [drill] of a seeder whose tray has so many holes. Throws InputError like read_scene.
Drill read_drill(Table table, std::size_t holes);

}  // namespace vibrosow
