// Compiled for each law (VIBROSOW_LAW) and instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include <utility>

#include "contact/laws.hpp"
#include "contact/pair_kernel.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

template <Law law>
const PairKernels& pair_kernels();

template <>
const PairKernels& pair_kernels<Law::VIBROSOW_LAW>() {
  static constexpr PairKernels kernels = []<std::size_t... index>(std::index_sequence<index...>) {
    return PairKernels{pair_forces<Registered<Law::VIBROSOW_LAW>::Formulas, PairEffects<compiled_effects[index]>>...};
  }
  (std::make_index_sequence<compiled_effects.size()>());
  return kernels;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
