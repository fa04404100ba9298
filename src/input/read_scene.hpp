#pragma once

#include <filesystem>
#include <vector>

#include "input/override.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads and validates a seeder file. `overrides` replace or add keys before it is read. Crops and contact models are
/// looked for by name in `models_directory()`, or as paths relative to the file that names them. Throws InputError on
/// anything wrong: unreadable file, TOML syntax, unknown key (with the nearest known one), missing unit, wrong
/// dimension, value out of range, contradicting keys, a hole off the floor or overlapping another.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// Where shipped presets lie: $VIBROSOW_DATA if set, the installed share directory beside the program, or the source
/// tree it was built from. Throws InputError when none exists.
std::filesystem::path data_directory();

}  // namespace vibrosow
