#pragma once

#include <array>

#include "contact/pair_block.hpp"
#include "contact/space_data.hpp"

namespace vibrosow {

/// Energy stored in all contacts of pairs, or of walls, J.
using PairEnergyKernel = double (*)(const GrainSurfaces&, const Motion&, const PairList&, const ContactParameters&,
                                    const ContactHistories&);
using WallEnergyKernel = double (*)(const GrainSurfaces&, const WallContacts&, const ContactParameters&,
                                    const ContactHistories&);

using SpacePairEnergyKernel = double (*)(const GrainSurfaces&, const SpaceMotion&, const PairList&,
                                         const ContactParameters&, const ContactHistories&);
using SpaceWallEnergyKernel = double (*)(const GrainSurfaces&, const SpaceWallContacts&, const ContactParameters&,
                                         const ContactHistories&);

struct EnergyKernel {
  PairEnergyKernel pair;
  WallEnergyKernel wall;
};
struct SpaceEnergyKernel {
  SpacePairEnergyKernel pair;
  SpaceWallEnergyKernel wall;
};

/// By index of `compiled_effects`.
using EnergyKernels = std::array<EnergyKernel, compiled_effects.size()>;
using SpaceEnergyKernels = std::array<SpaceEnergyKernel, compiled_effects.size()>;

}  // namespace vibrosow
