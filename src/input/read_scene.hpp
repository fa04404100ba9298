#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "input/override.hpp"
#include "input/source_files.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Reads and validates a seeder file. `overrides` replace, add or take out keys before it is read. Crops and contact
/// models are looked for by name in `data_directory()`, or as paths relative to the file that names them. Throws
/// InputError on anything wrong: unreadable file, TOML syntax, unknown key (with the nearest known one), missing unit,
/// wrong dimension, value out of range, contradicting keys, a hole off the floor or overlapping another. Every file is
/// read through `files`, so that many scenes on one base read it once.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// Where shipped presets lie: $VIBROSOW_DATA if set, the installed share directory beside the program, or the source
/// tree it was built from. Throws InputError when none exists.
std::filesystem::path data_directory();

}  // namespace vibrosow
