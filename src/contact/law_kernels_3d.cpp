// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER) and instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

#include <utility>

#include "contact/kernel_3d.hpp"
#include "contact/wall_kernel_3d.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <Law law>
const LawKernels3d& law_kernels_3d();

template <>
const LawKernels3d& law_kernels_3d<Law::VIBROSOW_LAW>() {
  static constexpr LawKernels3d kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    using Formulas = FormulasOf<Law::VIBROSOW_LAW>::Type;
    return LawKernels3d{VectorKernels3d{pair_forces_3d<Formulas, PairEffects<compiled_effects[index]>>,
                                        wall_forces_3d<Formulas, PairEffects<compiled_effects[index]>>}...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
