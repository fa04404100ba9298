#pragma once

#include <numbers>

namespace vibrosow {

// Units of readers and reports, in SI's.
inline constexpr double degree = std::numbers::pi / 180;                  // rad
inline constexpr double gram = 1e-3, milligram = 1e-6;                    // kg
inline constexpr double millimetre = 1e-3, millimetre_per_second = 1e-3;  // m, m/s
inline constexpr double megapascal = 1e6;                                 // Pa

}  // namespace vibrosow
