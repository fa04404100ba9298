#pragma once

#include <string>

#include "scene/mixture.hpp"

namespace vibrosow {

/// What each fill and rain of a mixture has of each lot, and each fill of each size in a lot's table, by number and by
/// mass, beside what was asked for: lines for a terminal; empty of one lot without a table. Masses are of what was
/// drawn, if that is known.
std::string mixture_text(const Scene& scene, const std::vector<DrawnSeeds>& drawn);

}  // namespace vibrosow
