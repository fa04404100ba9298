#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "agronomy/drill.hpp"
#include "input/drawing.hpp"
#include "input/override.hpp"
#include "input/source_files.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a seeder file says: the scene of its runs, what its outflow is to sow, and which drawings its pieces are from.
struct Seeder {
  Scene scene;
  std::optional<Drill> drill{};
  std::vector<Drawing> drawings{};
};

/// Reads and validates a seeder file. `overrides` replace, add or take out keys before it is read. Crops and contact
/// models are looked for by name in `data_directory()`, or as paths relative to the file that names them. Throws
/// InputError on anything wrong: unreadable file, TOML syntax, unknown key (with the nearest known one), missing unit,
/// wrong dimension, value out of range, contradicting keys, a hole off the floor or overlapping another. Every file is
/// read through `files`, so that many scenes on one base read it once.
Seeder read_seeder(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                   const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// One seeder for both spaces.
struct BothSpaces {
  Scene plane, space;
};

/// A seeder read anew for each space, so that what one of the two does not use is there for the other: a hole's shape,
/// a round plan, a thickness. Fill and rain are of the space that the file says, and in the other as many as its slices
/// make of them (`slices_of_vessel`). Throws InputError like `read_seeder`, and where the tray has no depth.
BothSpaces read_in_both_spaces(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                               const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// Its scene; a [drill] is read, and refused where it is wrong.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// Where shipped presets lie: $VIBROSOW_DATA if set, the installed share directory beside the program, or the source
/// tree it was built from. Throws InputError when none exists.
std::filesystem::path data_directory();

}  // namespace vibrosow
