// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

#include <utility>

#include "contact/energy_kernels.hpp"
#include "contact/pair_energy.hpp"
#include "contact/wall_energy.hpp"

namespace vibrosow {

template <Law law>
const EnergyKernels& energy_kernels();

template <>
const EnergyKernels& energy_kernels<Law::VIBROSOW_LAW>() {
  static constexpr EnergyKernels kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    using Formulas = FormulasOf<Law::VIBROSOW_LAW>::Type;
    return EnergyKernels{EnergyKernel{pair_energy<Formulas, PairEffects<compiled_effects[index]>>,
                                      wall_energy<Formulas, PairEffects<compiled_effects[index]>>}...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow
