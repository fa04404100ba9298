// Compiled for each instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include "box2d/near_places.hpp"

#include "compute/compress.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

int places_near(const Places& places, int after, double x, double y, double reach, int* near) {
  constexpr int block = 256;
  unsigned char flags[block + 16];
  int found = 0;
  for (int from = 0; from < places.count; from += block) {
    const int count = places.count - from < block ? places.count - from : block;
    const int* grain = places.grain + from;
    const double *px = places.x + from, *py = places.y + from, *pr = places.r + from;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const double dx = px[k] - x, dy = py[k] - y, limit = reach + pr[k];
      flags[k] = static_cast<unsigned char>((dx * dx + dy * dy < limit * limit ? 1 : 0) & (grain[k] > after ? 1 : 0));
    }
    found += compress(flags, count, Kept<int>{grain, near + found});
  }
  return found;
}

int places_near_3d(const Places& places, const double* heights, int after, double x, double y, double z, double reach,
                   int* near) {
  constexpr int block = 256;
  unsigned char flags[block + 16];
  int found = 0;
  for (int from = 0; from < places.count; from += block) {
    const int count = places.count - from < block ? places.count - from : block;
    const int* grain = places.grain + from;
    const double *px = places.x + from, *py = places.y + from, *pz = heights + from, *pr = places.r + from;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const double dx = px[k] - x, dy = py[k] - y, dz = pz[k] - z, limit = reach + pr[k];
      flags[k] = static_cast<unsigned char>((dx * dx + dy * dy + dz * dz < limit * limit ? 1 : 0) &
                                            (grain[k] > after ? 1 : 0));
    }
    found += compress(flags, count, Kept<int>{grain, near + found});
  }
  return found;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
