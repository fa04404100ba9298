#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "input/presets.hpp"
#include "input/read_lot.hpp"

namespace vibrosow {

/// A crop of models/crops or of a user, as a value.
struct Crop {
  std::string name;                 // of its file, without .toml
  std::string title;                // the name where it has none
  std::string shape;                // as in its file: "ball", "elongated", "drop", ..
  double length, width, thickness;  // m; of a ball, and of shapes that have no such keys, the diameter
  double mass;                      // kg, of one seed
  BulkProperties bulk;
  Reference reference;
  PresetFile contact;                          // the contact model that it names as its own; maybe none
  std::map<std::string, std::string> sources;  // by key: where each value comes from
};

/// The crop of a file. Throws InputError for anything wrong in it, as a seeder that names it would.
Crop read_crop(const std::filesystem::path& file);

/// A shipped crop by its name ("wheat"), or the crop of a path ending in .toml. Throws InputError with the shipped
/// names when it is neither.
Crop find_crop(const std::string& name_or_path);

}  // namespace vibrosow
