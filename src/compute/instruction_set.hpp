#pragma once

#include <array>
#include <string_view>

// Kernels are compiled once for each instruction set from the same source. What that source defines lives in a
// namespace of its instruction set, so that the linker can never hand the code of one processor to another.
#ifndef VIBROSOW_ISA
#define VIBROSOW_ISA generic
#endif

namespace vibrosow {

/// Vector instructions a processor may have; `generic` is what every processor of its kind has (SSE2 on x86-64). They
/// change the time of a run and never its result.
enum class InstructionSet { generic, avx2, avx512 };
inline constexpr std::array instruction_sets{InstructionSet::generic, InstructionSet::avx2, InstructionSet::avx512};

/// Whether this processor has it, and this program was built with it.
bool is_available(InstructionSet set);

/// The widest one available.
InstructionSet best_instruction_set();

/// "SSE2" or "generic", "AVX2", "AVX-512"
std::string_view name_of(InstructionSet set);

}  // namespace vibrosow
