#include <stdexcept>

#include "box2d/near_places.hpp"

namespace vibrosow {

// Defined in near_places.cpp, compiled for each.
inline namespace generic {
int places_near(const Places&, int, double, double, double, int*);
int places_near_in_space(const Places&, const double*, int, double, double, double, double, int*);
}  // namespace generic
namespace avx2 {
int places_near(const Places&, int, double, double, double, int*);
int places_near_in_space(const Places&, const double*, int, double, double, double, double, int*);
}  // namespace avx2
namespace avx512 {
int places_near(const Places&, int, double, double, double, int*);
int places_near_in_space(const Places&, const double*, int, double, double, double, double, int*);
}  // namespace avx512

NearPlaces near_places(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return avx2::places_near;
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512) return avx512::places_near;
#endif
  return generic::places_near;
}

NearPlacesInSpace near_places_in_space(InstructionSet set) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return avx2::places_near_in_space;
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512) return avx512::places_near_in_space;
#endif
  return generic::places_near_in_space;
}

}  // namespace vibrosow
