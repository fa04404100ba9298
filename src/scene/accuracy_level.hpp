#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What a level sets, and what its rates were found to err by.
struct AccuracyLevelValues {
  AccuracyLevel level;
  const char* name;          // what a seeder says
  double shell_compression;  // eps / r; with Hertz' law contacts last as long as such a shell's
  double steps_per_contact;
  // At 95 %, of the worst of three seeders of balls each in 2D and in 3D (reports/accuracy-levels, rounded up), and of
  // long grains (reports/grains-softness; "reference" was not tried).
  double error_2d_percent, error_3d_percent, grains_error_percent;

  /// Share of a rate that it stays within, at 95 %.
  double error(Space space, bool of_long_grains) const {
    if (of_long_grains) return grains_error_percent / 100;
    return (space == Space::two_dimensional ? error_2d_percent : error_3d_percent) / 100;
  }
};

/// From the cheapest to the most accurate.
inline constexpr std::array<AccuracyLevelValues, 3> accuracy_levels{
    {{AccuracyLevel::draft, "draft", 3e-4, 12, 11.4, 5.5, 7.3},
     {AccuracyLevel::design, "design", 3e-5, 12, 5.8, 5.2, 6.6},
     {AccuracyLevel::reference, "reference", 3e-6, 24, 2.6, 2.6, 6.6}}};

/// As JSON calls them, in the order of the enumeration.
inline const std::vector<std::string>& accuracy_level_names() {
  static const std::vector<std::string> names{"as-written", "draft", "design", "reference"};
  return names;
}

}  // namespace vibrosow
