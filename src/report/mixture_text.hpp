#pragma once

#include <string>

#include "scene/scene.hpp"

namespace vibrosow {

/// What each fill and rain of a mixture has of each lot, by number and by mass, beside what was asked for: lines for a
/// terminal, empty where there is one lot.
std::string mixture_text(const Scene& scene);

}  // namespace vibrosow
