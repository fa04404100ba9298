#pragma once

#include "contact/pair_block.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What the kernels know of a scene's contacts.
ContactParameters contact_parameters(const Scene& scene);

}  // namespace vibrosow
