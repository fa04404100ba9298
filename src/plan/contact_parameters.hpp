#pragma once

#include <vector>

#include "contact/pair_block.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What the kernels know of a scene's contacts: restitutions as damping ratios, stiffnesses as ratios of the law's.
ContactParameters contact_parameters(const Contact& contact, const std::vector<SeedLot>& lots);

}  // namespace vibrosow
