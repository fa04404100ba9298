// Compiled for each instruction set (VIBROSOW_ISA), see src/CMakeLists.txt.
#include "contact/over_plates.hpp"

#include "compute/four.hpp"

namespace vibrosow::inline VIBROSOW_ISA {
namespace {

const Four& as_four(const GrainVector& vector) {
  return reinterpret_cast<const Four&>(vector);
}

/// Four candidates, of which each row holds one number.
struct Places4 {
  Four place[4];
  const PlateRows* plate[4];

  /// Along a direction of each one's plate. (Not returned: without AVX compilers do not agree on how.)
  [[gnu::always_inline]] void along(GrainVector PlateRows::*direction, Four& distances) const {
    Four rows[4];
    for (int k = 0; k < 4; ++k) rows[k] = place[k] * as_four(plate[k]->*direction);
    transpose(rows);
    distances = rows[0] + rows[1] + rows[2] + rows[3];
  }
  [[gnu::always_inline]] void columns(GrainVector PlateRows::*member, Four (&rows)[4]) const {
    for (int k = 0; k < 4; ++k) rows[k] = as_four(plate[k]->*member);
    transpose(rows);
  }
};

}  // namespace

void balls_over_plates(std::size_t n, const WallCandidate* candidates, const Coordinates& at, PerGrain radius,
                       const PlateRows* plates, double* height, OverPlate* stands) {
  for (std::size_t from = 0; from < n; from += 4) {
    const std::size_t count = n - from < 4 ? n - from : 4;
    Places4 four;
    Four side, reach;
    for (std::size_t k = 0; k < 4; ++k) {
      const WallCandidate& candidate = candidates[from + (k < count ? k : count - 1)];
      const std::size_t i = static_cast<std::size_t>(candidate.grain);
      four.place[k] = Four{at.x[i], at.y[i], at.z[i], 1};
      four.plate[k] = plates + candidate.wall;
      side[k] = candidate.side;
      reach[k] = radius.each ? radius.each[i] : radius.same;
    }
    Four h, u, v, sides[4], holes[4];
    four.along(&PlateRows::normal, h), four.along(&PlateRows::e1, u), four.along(&PlateRows::e2, v);
    four.columns(&PlateRows::sides, sides), four.columns(&PlateRows::holes, holes);
    const auto clear = (h * side > 0) & (h * h >= reach * reach);
    const auto inside = (u > 0) & (u < sides[0]) & (v > 0) & (v < sides[1]);
    const auto by_holes = (u >= holes[0]) & (u <= holes[1]) & (v >= holes[2]) & (v <= holes[3]);
    for (std::size_t k = 0; k < count; ++k) {
      height[from + k] = h[k];
      stands[from + k] = clear[k]                        ? OverPlate::clear
                         : inside[k] && by_holes[k] == 0 ? OverPlate::flat
                                                         : OverPlate::other;
    }
  }
}

}  // namespace vibrosow::inline VIBROSOW_ISA
