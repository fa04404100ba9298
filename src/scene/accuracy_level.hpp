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
  double error_percent;         // at 95 %, of the worst of six seeders of balls: reports/accuracy-levels, rounded up
  double grains_error_percent;  // the same of long grains: reports/grains-softness; "reference" was not tried

  /// Share of a rate that it stays within, at 95 %.
  double error(bool of_long_grains) const { return (of_long_grains ? grains_error_percent : error_percent) / 100; }
};

/// From the cheapest to the most accurate.
inline constexpr std::array<AccuracyLevelValues, 3> accuracy_levels{
    {{AccuracyLevel::draft, "draft", 3e-4, 12, 11.4, 7.3},
     {AccuracyLevel::design, "design", 3e-5, 12, 5.9, 6.6},
     {AccuracyLevel::reference, "reference", 3e-6, 24, 2.6, 6.6}}};

/// As JSON calls them, in the order of the enumeration.
inline const std::vector<std::string>& accuracy_level_names() {
  static const std::vector<std::string> names{"as-written", "draft", "design", "reference"};
  return names;
}

}  // namespace vibrosow
