#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

// Over a periodic tray a hopper stands in every period: a grain that is carried over to the tray's other side, or
// stands beyond a side, meets the walls of the hopper there.

/// The hoppers beside the scene's own, one period to either side, with its name, and no seeds of their own. None
/// without a hopper or a period; none in a direction in which the hopper itself is periodic.
std::vector<Vessel> hopper_images(const Scene& scene);

/// Why a hopper cannot stand over its periodic tray, and the hopper's key that says so: it does not lie within the
/// tray's length, does not clear its own images, or moves on to where these have no walls.
struct ImageFault {
  std::string key, message;
};
std::optional<ImageFault> image_fault(const Scene& scene);

/// How far (m) beyond a side of a periodic tray a grain is carried over to the other one, so that none goes to and fro:
/// a diameter of the largest lot, and where grains there may touch a hopper, as far as tray and hopper move against
/// each other as well, but no more than a quarter of the shorter period.
double carried_beyond(const Scene& scene);

}  // namespace vibrosow
