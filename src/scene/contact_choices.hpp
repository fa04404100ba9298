#pragma once

#include <cstddef>

namespace vibrosow {

/// The table of normal laws: NAME is an enumerator of `Law` and the header laws/NAME.hpp, which says everything about
/// the law (laws/law.hpp tells what that is).
#define VIBROSOW_LAWS(LAW) \
  LAW(elastic_shell)       \
  LAW(hertz)               \
  LAW(hertz_viscous)

#define VIBROSOW_ENUMERATOR(name) name,
enum class Law { VIBROSOW_LAWS(VIBROSOW_ENUMERATOR) };
#undef VIBROSOW_ENUMERATOR

#define VIBROSOW_COUNT(name) +1
inline constexpr std::size_t law_count = 0 VIBROSOW_LAWS(VIBROSOW_COUNT);
#undef VIBROSOW_COUNT

/// sliding: sign law made continuous below the slip speed (paper A); spring: a tangential spring with Coulomb's limit.
enum class FrictionModel { sliding, spring };

/// constant_torque and spring (elastic-plastic spring and dashpot) as named by Ai et al. 2011, models A and C.
enum class Rolling { none, constant_torque, spring };

}  // namespace vibrosow
