#pragma once

#include "compute/instruction_set.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Four numbers that vector instructions load and add at once, whatever their places in memory are called.
using Four [[gnu::vector_size(32), gnu::may_alias]] = double;

/// From and to any place: compilers do not agree on types of vectors that are less aligned than long.
inline void load(Four& four, const double* from) {
  __builtin_memcpy(&four, from, sizeof four);
}

inline void store(const Four& four, double* to) {
  __builtin_memcpy(to, &four, sizeof four);
}

/// Row n becomes column n.
inline void transpose(Four (&rows)[4]) {
  const Four even01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
             odd01 = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Four even23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
             odd23 = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
}

}  // namespace vibrosow::inline VIBROSOW_ISA
