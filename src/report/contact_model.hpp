#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// A contact model as a file, for `[contact] model = "FILE.toml"`: read with a seeder whose [contact] says nothing else
/// it gives the same contact. Surfaces of pairs of materials and what a lot says of itself are a seeder's own and not
/// in it. `sources`: where each key is from, by its name in the file.
std::string contact_model_toml(const Contact& contact, const std::string& title,
                               const std::vector<std::pair<std::string, std::string>>& sources);

}  // namespace vibrosow
