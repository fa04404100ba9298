#pragma once

#include <string>
#include <string_view>

#include "scene/scene.hpp"

namespace vibrosow {

/// The whole scene as one line of JSON, in SI (a key's last word is its unit): the same text for equal scenes, and
/// another for different ones, but that 0 and -0 differ. Numbers have the digits that read back to the same double; a
/// time that never comes is null. What the scene's law, model or shape does not use has a key only where it is not at
/// its default. Throws std::invalid_argument for what JSON cannot say: a number that is not finite where it is no time,
/// or a text that is not UTF-8.
std::string scene_to_json(const Scene& scene);

/// The scene of which `scene_to_json` made the text, or an equal text laid out in another way; its values know of no
/// place in a file. Checks that everything is there, of the right type, fits together (lists of equal length, lots that
/// exist) and lies within the ranges of a seeder's keys or somewhat wider ones. Throws InputError
/// "scene.tray.holes[0].width_m: expected a number, not a text" with the path of the first thing that is wrong.
Scene scene_from_json(std::string_view json);

/// The same of a scene whose texts and numbers may be anything, which no run must be made of.
Scene scene_of_any_numbers(std::string_view json);

}  // namespace vibrosow
