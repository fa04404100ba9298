#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <type_traits>

#include "compute/instruction_set.hpp"

// For the tables of what is compiled once for each instruction set: each a source that src/CMakeLists.txt tells which
// sets there are.

/// Declares the same in the namespace of each.
#define VIBROSOW_DECLARE_IN_EACH_SET(...) \
  inline namespace generic {              \
  __VA_ARGS__                             \
  }                                       \
  namespace avx2 {                        \
  __VA_ARGS__                             \
  }                                       \
  namespace avx512 {                      \
  __VA_ARGS__                             \
  }

#ifdef VIBROSOW_AVX2
#define VIBROSOW_OF_AVX2(prefix, ...) prefix avx2::__VA_ARGS__
#else
#define VIBROSOW_OF_AVX2(prefix, ...) \
  {}
#endif
#ifdef VIBROSOW_AVX512
#define VIBROSOW_OF_AVX512(prefix, ...) prefix avx512::__VA_ARGS__
#else
#define VIBROSOW_OF_AVX512(prefix, ...) \
  {}
#endif
/// In the order of `instruction_sets`, null for those that this program was not built with. `prefix`: & or nothing,
/// before the name.
#define VIBROSOW_OF_EACH_SET(prefix, ...) \
  { prefix generic::__VA_ARGS__, VIBROSOW_OF_AVX2(prefix, __VA_ARGS__), VIBROSOW_OF_AVX512(prefix, __VA_ARGS__) }

namespace vibrosow {

template <class Pointer>
using OfEachSet = std::array<Pointer, instruction_sets.size()>;

/// The one for `set`. Throws std::logic_error where it is not available.
template <class Pointer>
Pointer of_set(InstructionSet set, const std::type_identity_t<OfEachSet<Pointer>>& each) {
  if (!is_available(set)) throw std::logic_error("these vector instructions are not available");
  return each[static_cast<std::size_t>(set)];
}

}  // namespace vibrosow
