// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

#include <utility>

#include "contact/energy_3d.hpp"
#include "contact/energy_kernels.hpp"

namespace vibrosow {

template <Law law>
const EnergyKernels3d& energy_kernels_3d();

template <>
const EnergyKernels3d& energy_kernels_3d<Law::VIBROSOW_LAW>() {
  static constexpr EnergyKernels3d kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    using Formulas = FormulasOf<Law::VIBROSOW_LAW>::Type;
    return EnergyKernels3d{EnergyKernel3d{pair_energy_3d<Formulas, PairEffects<compiled_effects[index]>>,
                                          wall_energy_3d<Formulas, PairEffects<compiled_effects[index]>>}...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow
