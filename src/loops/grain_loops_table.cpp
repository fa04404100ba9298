#include "compute/each_instruction_set.hpp"
#include "loops/clump_loops.hpp"
#include "loops/grain_loops.hpp"
#include "loops/loops_3d.hpp"

namespace vibrosow {

// Defined in grain_loops.cpp, loops_3d.cpp and clump_loops.cpp, compiled for each.
VIBROSOW_DECLARE_IN_EACH_SET(extern const GrainLoops loops; extern const Loops3d loops_3d;
                             extern const ClumpLoops loops_of_clumps;)

const GrainLoops& grain_loops(InstructionSet set) {
  return *of_set<const GrainLoops*>(set, VIBROSOW_OF_EACH_SET(&, loops));
}

#ifdef VIBROSOW_PLANE_ALONE  // of a program that simulates nothing in 3D, and is to be small
const Loops3d& loops_3d(InstructionSet) {
  static constexpr Loops3d none{};
  return none;
}

const ClumpLoops& clump_loops(InstructionSet) {
  static constexpr ClumpLoops none{};
  return none;
}
#else
const Loops3d& loops_3d(InstructionSet set) {
  return *of_set<const Loops3d*>(set, VIBROSOW_OF_EACH_SET(&, loops_3d));
}

const ClumpLoops& clump_loops(InstructionSet set) {
  return *of_set<const ClumpLoops*>(set, VIBROSOW_OF_EACH_SET(&, loops_of_clumps));
}
#endif

}  // namespace vibrosow
