#pragma once

#include <vector>

#include "grains/grains.hpp"
#include "laws/law.hpp"
#include "scene/scene.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

/// Grains as contacts see them: of a lot with a distribution its smallest and its largest, of a clump its discs.
/// `kinds`: a seed of each lot's diameter.
std::vector<GrainKind> touching_kinds(const std::vector<SeedLot>& lots, const std::vector<SeedSizes>& sizes,
                                      const std::vector<GrainKind>& kinds, const LawTraits& law);

}  // namespace vibrosow
