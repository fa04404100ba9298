#pragma once

#include "scene/scene.hpp"

namespace vibrosow {

/// The surface between two lots, or of a lot and the walls (`other` = -1).
const Surface& surface_between(const Contact& contact, int lot, int other);

}  // namespace vibrosow
