#pragma once

#include <vector>

#include "contact/pair_block.hpp"
#include "laws/law.hpp"
#include "scene/scene.hpp"
#include "scene/surfaces.hpp"

namespace vibrosow {

/// What the kernels know of a scene's contacts: restitutions as damping ratios, stiffnesses as ratios of the law's.
/// `materials`: by lot.
ContactParameters contact_parameters(const Contact& contact, const Surfaces& surfaces,
                                     const std::vector<SeedMaterial>& materials, const LawTraits& law);

}  // namespace vibrosow
