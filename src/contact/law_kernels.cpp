// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER) and instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

#include <utility>

#include "contact/pair_kernel.hpp"
#include "contact/wall_kernel.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <Law law>
const LawKernels& law_kernels();

template <>
const LawKernels& law_kernels<Law::VIBROSOW_LAW>() {
  static constexpr LawKernels kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    using Formulas = FormulasOf<Law::VIBROSOW_LAW>::Type;
    return LawKernels{VectorKernels{pair_forces<Formulas, PairEffects<compiled_effects[index]>>,
                                    wall_forces<Formulas, PairEffects<compiled_effects[index]>>}...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
