#pragma once

#include "compute/instruction_set.hpp"
#ifdef __AVX512BW__
#include <immintrin.h>
#endif

namespace vibrosow::inline VIBROSOW_ISA {

/// An array, and where what is kept of it goes, which has 16 places to spare.
template <class Value>
struct Kept {
  const Value* from;
  Value* to;
};

#ifdef __AVX512BW__
// The one loop that compilers do not turn into vector instructions by themselves.
inline void compress_sixteen(Kept<int> array, int k, int kept, int chosen) {
  const __mmask16 mask = static_cast<__mmask16>(chosen);
  _mm512_storeu_si512(array.to + kept,
                      _mm512_maskz_compress_epi32(mask, _mm512_maskz_loadu_epi32(mask, array.from + k)));
}
inline void compress_sixteen(Kept<double> array, int k, int kept, int chosen) {
  const auto eight = [&array](int from, int to, int flags) {
    const __mmask8 mask = static_cast<__mmask8>(flags);
    _mm512_storeu_pd(array.to + to, _mm512_maskz_compress_pd(mask, _mm512_maskz_loadu_pd(mask, array.from + from)));
  };
  eight(k, kept, chosen & 0xff);
  eight(k + 8, kept + __builtin_popcount(chosen & 0xff), chosen >> 8);
}
#endif

/// Keeps, of each array, the elements k in [0, count) whose flag, 0 or 1, is 1, in order, and returns how many. `flags`
/// have 16 places to spare.
template <class... Value>
int compress(const unsigned char* flags, int count, Kept<Value>... arrays) {
  int kept = 0;
#ifdef __AVX512BW__
  for (int k = 0; k < count; k += 16) {
    const __m128i sixteen = _mm_loadu_si128(reinterpret_cast<const __m128i*>(flags + k));
    const int within = count - k < 16 ? (1 << (count - k)) - 1 : 0xffff;
    const int chosen = static_cast<int>(_mm_test_epi8_mask(sixteen, sixteen)) & within;
    (compress_sixteen(arrays, k, kept, chosen), ...);
    kept += __builtin_popcount(static_cast<unsigned>(chosen));
  }
#else
  for (int k = 0; k < count; ++k) {
    ((arrays.to[kept] = arrays.from[k]), ...);
    kept += flags[k];  // without a branch, which nobody could predict
  }
#endif
  return kept;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
