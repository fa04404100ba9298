#include "box2d/near_places.hpp"
#include "compute/each_instruction_set.hpp"

namespace vibrosow {

// Defined in near_places.cpp, compiled for each.
VIBROSOW_DECLARE_IN_EACH_SET(int places_near(const Places&, int, double, double, double, int*);
                             int places_near_3d(const Places&, const double*, int, double, double, double, double,
                                                int*);)

NearPlaces near_places(InstructionSet set) {
  return of_set<NearPlaces>(set, VIBROSOW_OF_EACH_SET(, places_near));
}

NearPlaces3d near_places_3d(InstructionSet set) {
  return of_set<NearPlaces3d>(set, VIBROSOW_OF_EACH_SET(, places_near_3d));
}

}  // namespace vibrosow
