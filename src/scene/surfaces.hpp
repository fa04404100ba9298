#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// The surfaces that can meet.
struct Surfaces {
  std::vector<Surface> pairs;  // lots x lots, symmetric
  std::vector<Surface> walls;  // of each lot against the walls
};

/// For a scene of `lots` lots: each pair's own surface, or the contact's.
Surfaces meeting_surfaces(const Contact& contact, std::size_t lots);

}  // namespace vibrosow
