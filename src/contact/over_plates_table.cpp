#include <stdexcept>

#include "contact/over_plates.hpp"

namespace vibrosow {

// Defined in over_plates.cpp, compiled for each.
inline namespace generic {
void balls_over_plates(std::size_t, const WallCandidate*, const Coordinates&, PerGrain, const PlateRows*, double*,
                       OverPlate*);
}  // namespace generic
namespace avx2 {
void balls_over_plates(std::size_t, const WallCandidate*, const Coordinates&, PerGrain, const PlateRows*, double*,
                       OverPlate*);
}  // namespace avx2
namespace avx512 {
void balls_over_plates(std::size_t, const WallCandidate*, const Coordinates&, PerGrain, const PlateRows*, double*,
                       OverPlate*);
}  // namespace avx512

OverPlates over_plates(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return avx2::balls_over_plates;
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512) return avx512::balls_over_plates;
#endif
  return generic::balls_over_plates;
}

}  // namespace vibrosow
