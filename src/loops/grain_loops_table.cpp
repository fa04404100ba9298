#include <stdexcept>

#include "loops/clump_loops.hpp"
#include "loops/grain_loops.hpp"
#include "loops/space_loops.hpp"

namespace vibrosow {

// Defined in grain_loops.cpp, space_loops.cpp and clump_loops.cpp, compiled for each that VIBROSOW_INSTRUCTION_SETS
// names.
inline namespace generic {
extern const GrainLoops loops;
extern const SpaceLoops loops_in_space;
extern const ClumpLoops loops_of_clumps;
}  // namespace generic
namespace avx2 {
extern const GrainLoops loops;
extern const SpaceLoops loops_in_space;
extern const ClumpLoops loops_of_clumps;
}  // namespace avx2
namespace avx512 {
extern const GrainLoops loops;
extern const SpaceLoops loops_in_space;
extern const ClumpLoops loops_of_clumps;
}  // namespace avx512

const GrainLoops& grain_loops(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return avx2::loops;
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512) return avx512::loops;
#endif
  return generic::loops;
}

#ifdef VIBROSOW_PLANE_ALONE  // of a program that simulates nothing in space, and is to be small
const SpaceLoops& space_loops(InstructionSet) {
  static constexpr SpaceLoops none{};
  return none;
}

const ClumpLoops& clump_loops(InstructionSet) {
  static constexpr ClumpLoops none{};
  return none;
}
#else
const SpaceLoops& space_loops(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return avx2::loops_in_space;
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512) return avx512::loops_in_space;
#endif
  return generic::loops_in_space;
}

const ClumpLoops& clump_loops(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return avx2::loops_of_clumps;
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512) return avx512::loops_of_clumps;
#endif
  return generic::loops_of_clumps;
}
#endif

}  // namespace vibrosow
