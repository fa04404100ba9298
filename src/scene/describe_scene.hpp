#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.hpp"

namespace vibrosow {

/// Everything of a scene that influences a run, in SI, and nothing else (no title): two scenes with the same
/// dump() run alike. Numbers are dumped with the fewest digits that read back to the same double.
/// A value that the scene's law or model does not use, and an effect that is absent, have no key.
nlohmann::ordered_json describe_scene(const Scene& scene);

}  // namespace vibrosow
