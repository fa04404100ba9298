#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What in the walls of a scene can hardly be meant: pieces over holes, vessels that pass through each other, pieces
/// below the counting line, pieces far larger than their vessel. Sentences that begin with the key.
std::vector<std::string> geometry_warnings(const Scene& scene);

}  // namespace vibrosow
