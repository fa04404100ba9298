#pragma once

#include <array>

#include "contact/data_3d.hpp"
#include "contact/pair_block.hpp"

namespace vibrosow {

/// Energy stored in all contacts of pairs, or of walls, J.
using PairEnergyKernel = double (*)(const GrainSurfaces&, const Motion&, const PairList&, const ContactParameters&,
                                    const ContactHistories&);
using WallEnergyKernel = double (*)(const GrainSurfaces&, const WallContacts&, const ContactParameters&,
                                    const ContactHistories&);

using PairEnergyKernel3d = double (*)(const GrainSurfaces&, const Motion3d&, const PairList&, const ContactParameters&,
                                      const ContactHistories&);
using WallEnergyKernel3d = double (*)(const GrainSurfaces&, const WallContacts3d&, const ContactParameters&,
                                      const ContactHistories&);

struct EnergyKernel {
  PairEnergyKernel pair;
  WallEnergyKernel wall;
};
struct EnergyKernel3d {
  PairEnergyKernel3d pair;
  WallEnergyKernel3d wall;
};

/// By index of `compiled_effects`.
using EnergyKernels = std::array<EnergyKernel, compiled_effects.size()>;
using EnergyKernels3d = std::array<EnergyKernel3d, compiled_effects.size()>;

}  // namespace vibrosow
