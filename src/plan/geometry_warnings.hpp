#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What in the walls of a scene can hardly be meant: pieces over holes, of the same vessel or, as they stand at the
/// start, the other; vessels that pass through each other; pieces below the counting line, far larger than their
/// vessel, or further away than its next period. Sentences that begin with the key.
std::vector<std::string> geometry_warnings(const Scene& scene);

}  // namespace vibrosow
