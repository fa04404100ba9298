#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What changes while rates are measured, so that they are means of two conditions, or not until then, so that they are
/// of another condition than the file's: a vessel's motion that builds up or ends within the measuring window, a gate
/// of the tray or the hopper that opens in it or after it, rain that begins or ends in it, a table of motion that
/// begins late or ends early. Empty where all of it is steady, and of a scene that measures nothing.
std::vector<std::string> steadiness_warnings(const Scene& scene);

}  // namespace vibrosow
