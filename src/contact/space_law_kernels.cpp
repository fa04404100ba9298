// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER) and instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

#include <utility>

#include "contact/space_kernel.hpp"
#include "contact/space_wall_kernel.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <Law law>
const SpaceLawKernels& space_law_kernels();

template <>
const SpaceLawKernels& space_law_kernels<Law::VIBROSOW_LAW>() {
  static constexpr SpaceLawKernels kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    using Formulas = FormulasOf<Law::VIBROSOW_LAW>::Type;
    return SpaceLawKernels{SpaceVectorKernels{space_pair_forces<Formulas, PairEffects<compiled_effects[index]>>,
                                              space_wall_forces<Formulas, PairEffects<compiled_effects[index]>>}...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
