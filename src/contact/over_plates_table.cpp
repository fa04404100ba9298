#include "compute/each_instruction_set.hpp"
#include "contact/over_plates.hpp"

namespace vibrosow {

// Defined in over_plates.cpp, compiled for each.
VIBROSOW_DECLARE_IN_EACH_SET(void balls_over_plates(std::size_t, const WallCandidate*, const Coordinates&, PerGrain,
                                                    const PlateRows*, double*, OverPlate*);)

OverPlates over_plates(InstructionSet set) {
  return of_set<OverPlates>(set, VIBROSOW_OF_EACH_SET(, balls_over_plates));
}

}  // namespace vibrosow
