#include "compute/instruction_set.hpp"

#include <algorithm>

namespace vibrosow {

bool is_available(InstructionSet set) {
#ifdef VIBROSOW_AVX2
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
#endif
#ifdef VIBROSOW_AVX512
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
#endif
  return set == InstructionSet::generic;
}

InstructionSet best_instruction_set() {
  return *std::find_if(instruction_sets.rbegin(), instruction_sets.rend(), is_available);
}

std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2:
      return "AVX2";
    case InstructionSet::avx512:
      return "AVX-512";
    default:
#ifdef VIBROSOW_X86
      return "SSE2";
#else
      return "generic";
#endif
  }
}

}  // namespace vibrosow
