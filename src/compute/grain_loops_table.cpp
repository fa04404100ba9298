#include <stdexcept>

#include "compute/grain_loops.hpp"

namespace vibrosow {

// Defined in grain_loops.cpp, compiled for each.
inline namespace generic {
extern const GrainLoops loops;
}
namespace avx2 {
extern const GrainLoops loops;
}
namespace avx512 {
extern const GrainLoops loops;
}

const GrainLoops& grain_loops(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_X86_KERNELS
  if (set == InstructionSet::avx2) return avx2::loops;
  if (set == InstructionSet::avx512) return avx512::loops;
#endif
  return generic::loops;
}

}  // namespace vibrosow
