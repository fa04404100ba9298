#pragma once

#include <string>

#include "scene/scene.hpp"

namespace vibrosow {

/// The seeds of a crop, in 3D, as a seeder reads them whose table [seeds.NAME] names the crop and nothing else.
/// `crop`: a shipped one's name, or a path ending in .toml. `where` stands before messages: an option. Throws
/// InputError for what such a seeder would be refused for.
SeedLot read_crop_lot(const std::string& crop, const std::string& where);

}  // namespace vibrosow
