#pragma once

#include <optional>
#include <string>

#include "scene/scene.hpp"

namespace vibrosow {

/// Where walls of the hopper first pass through walls of the tray.
struct VesselsMeet {
  double time;        // s, of the look that found it
  std::string walls;  // "tray floor 1 and hopper right wall"
};

/// Over the whole run; what touches or overlaps by less than a hundredth of the smallest lot's mean seed does not meet.
std::optional<VesselsMeet> first_meeting_of_vessels(const Scene& scene);

}  // namespace vibrosow
