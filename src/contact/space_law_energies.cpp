// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

#include <utility>

#include "contact/energy_kernels.hpp"
#include "contact/space_energy.hpp"

namespace vibrosow {

template <Law law>
const SpaceEnergyKernels& space_energy_kernels();

template <>
const SpaceEnergyKernels& space_energy_kernels<Law::VIBROSOW_LAW>() {
  static constexpr SpaceEnergyKernels kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    using Formulas = FormulasOf<Law::VIBROSOW_LAW>::Type;
    return SpaceEnergyKernels{SpaceEnergyKernel{space_pair_energy<Formulas, PairEffects<compiled_effects[index]>>,
                                                space_wall_energy<Formulas, PairEffects<compiled_effects[index]>>}...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow
