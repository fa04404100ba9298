#pragma once

#include "contact/instruction_set.hpp"
#ifdef __AVX512BW__
#include <immintrin.h>
#endif

namespace vibrosow::inline VIBROSOW_ISA {

/// Writes first + k for each k in [0, count) whose flag is 1, in order, and returns how many. `flags` are 0 or 1 and,
/// like `positions`, have 16 places to spare.
inline int positions_of_set(const unsigned char* flags, int count, int first, int* positions) {
  int set = 0;
#ifdef __AVX512BW__
  // The one loop that compilers do not turn into vector instructions by themselves.
  __m512i index = _mm512_add_epi32(_mm512_set1_epi32(first),
                                   _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  for (int k = 0; k < count; k += 16) {
    const __m128i sixteen = _mm_loadu_si128(reinterpret_cast<const __m128i*>(flags + k));
    const int within = count - k < 16 ? (1 << (count - k)) - 1 : 0xffff;
    const __mmask16 chosen = static_cast<__mmask16>(_mm_test_epi8_mask(sixteen, sixteen) & within);
    _mm512_storeu_si512(positions + set, _mm512_maskz_compress_epi32(chosen, index));
    set += __builtin_popcount(chosen);
    index = _mm512_add_epi32(index, _mm512_set1_epi32(16));
  }
#else
  for (int k = 0; k < count; ++k) {
    positions[set] = first + k;
    set += flags[k];  // without a branch, which nobody could foretell
  }
#endif
  return set;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
