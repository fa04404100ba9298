#include "compute/each_instruction_set.hpp"
#include "loops/clump_loops.hpp"
#include "loops/grain_loops.hpp"
#include "loops/space_loops.hpp"

namespace vibrosow {

// Defined in grain_loops.cpp, space_loops.cpp and clump_loops.cpp, compiled for each.
VIBROSOW_DECLARE_IN_EACH_SET(extern const GrainLoops loops; extern const SpaceLoops loops_in_space;
                             extern const ClumpLoops loops_of_clumps;)

const GrainLoops& grain_loops(InstructionSet set) {
  return *of_set<const GrainLoops*>(set, VIBROSOW_OF_EACH_SET(&, loops));
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
  return *of_set<const SpaceLoops*>(set, VIBROSOW_OF_EACH_SET(&, loops_in_space));
}

const ClumpLoops& clump_loops(InstructionSet set) {
  return *of_set<const ClumpLoops*>(set, VIBROSOW_OF_EACH_SET(&, loops_of_clumps));
}
#endif

}  // namespace vibrosow
