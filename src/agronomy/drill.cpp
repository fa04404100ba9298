#include "agronomy/drill.hpp"

#include <algorithm>

namespace vibrosow {

std::size_t Drill::stream_of(std::size_t hole) const {
  return static_cast<std::size_t>((hole_to_row.at(hole) - 1) / rows_per_hole);
}

int Drill::streams() const {
  return hole_to_row.empty() ? 0 : (std::ranges::max(hole_to_row) - 1) / rows_per_hole + 1;
}

}  // namespace vibrosow
