#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contact/contact_list.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

struct PairReach {
  double reach, distance2;  // m, m^2
};

/// Calls `act(k, i, j, overlap)` for the entries k of a list whose grains i and j touch, in order; `measure(i, j)` says
/// how far apart two are. Which of them touch is found a block at a time and without a branch, as no processor would
/// foresee it.
template <class Measure, class Act>
inline void for_each_touching(const PairList& list, Measure measure, Act act) {
  constexpr std::size_t block = 256;
  std::array<std::size_t, block> near;
  const auto grain = [&](std::size_t k) { return static_cast<std::size_t>(list.grain[k]); };
  const auto partner = [&](std::size_t k) { return static_cast<std::size_t>(list.partner[k]); };
  for (std::size_t begin = 0; begin < list.size(); begin += block) {
    const std::size_t end = std::min(begin + block, list.size());
    std::size_t found = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const PairReach pair = measure(grain(k), partner(k));
      near[found] = k;
      found += pair.distance2 < pair.reach * pair.reach;  // else the root is not less than reach, by IEEE's rounding
    }
    for (std::size_t n = 0; n < found; ++n) {
      const std::size_t k = near[n], i = grain(k), j = partner(k);
      const PairReach pair = measure(i, j);
      const double overlap = pair.reach - std::sqrt(pair.distance2);
      if (overlap > 0) act(k, i, j, overlap);
    }
  }
}

}  // namespace vibrosow::inline VIBROSOW_ISA
