#pragma once

#include <string>
#include <vector>

#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a cumulative curve counts.
enum class Discharge {
  seeds,
  mass,      // kg, of the plane slice
  fraction,  // of the mass of the fill at the start, as a fraction
};

/// What has left the tray's holes up to and including each of `times` (s, in any order), in total or for one
/// hole ("1"..) and lot (name); spilled grains are left out. The fill's mass is its number of grains times
/// the lots' mean mass. A time beyond the run's end gives not a number. Throws std::invalid_argument for a
/// hole or lot that the scene has not.
std::vector<double> discharge_curve(const Scene& scene, const Run& run, const std::vector<double>& times,
                                    Discharge kind, const std::string& hole = "all", const std::string& lot = "all");

}  // namespace vibrosow
