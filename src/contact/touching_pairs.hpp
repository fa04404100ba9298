#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vibrosow::inline VIBROSOW_ISA {

struct PairReach {
  double reach, distance2;  // m, m^2
};

/// Calls `act(k, overlap)` for those of `count` entries of a list that touch, in order. Which of them touch is found a
/// block at a time and without a branch, as no processor would foresee it.
template <class Measure, class Act>
inline void for_each_touching(std::size_t count, Measure measure, Act act) {
  constexpr std::size_t block = 256;
  std::array<std::size_t, block> near;
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t end = std::min(begin + block, count);
    std::size_t found = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const PairReach pair = measure(k);
      near[found] = k;
      found += pair.distance2 < pair.reach * pair.reach;  // else the root is not less than reach, by IEEE's rounding
    }
    for (std::size_t n = 0; n < found; ++n) {
      const PairReach pair = measure(near[n]);
      const double overlap = pair.reach - std::sqrt(pair.distance2);
      if (overlap > 0) act(near[n], overlap);
    }
  }
}

}  // namespace vibrosow::inline VIBROSOW_ISA
