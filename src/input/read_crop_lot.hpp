#pragma once

#include <optional>
#include <string>

#include "input/presets.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The seeds of a crop, in 3D, as a seeder reads them whose table [seeds.NAME] names the crop and nothing else.
/// `crop`: a shipped one's name, or a path ending in .toml. `where` stands before messages: an option. Throws
/// InputError for what such a seeder would be refused for.
SeedLot read_crop_lot(const std::string& crop, const std::string& where);

/// The contact model that a crop names, and what its file says of how well it is known.
struct CropContact {
  Contact contact;
  Reference reference;
};
/// None where the crop names none.
std::optional<CropContact> read_crop_contact(const std::string& crop, const std::string& where);

}  // namespace vibrosow
