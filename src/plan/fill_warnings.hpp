#pragma once

#include <string>
#include <vector>

#include "grains/grains.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Whether a fill's amount was given by its height.
bool is_filled_to_height(const Vessel& vessel);
bool has_fill_to_height(const Scene& scene);

/// Where poured seeds lie much higher than was asked for: more than a fifth of that, and than a seed's thickness.
/// `grains`: as the fills were put in, the tray's first. Sentences that begin with the key.
std::vector<std::string> fill_warnings(const Scene& scene, const Grains& grains);

}  // namespace vibrosow
