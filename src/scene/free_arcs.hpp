#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

struct Arc {
  double from, to;  // rad, from < to
};

/// Arcs of disc i's rim that no other disc covers; z does not matter.
std::vector<Arc> free_arcs(const std::vector<ClumpDisc>& discs, std::size_t i);

/// An arc in equal parts of at most a quarter turn, on which Gauss' rule of 20 points integrates a low polynomial in x
/// and y exactly to rounding.
std::vector<Arc> quarters(const Arc& arc);

}  // namespace vibrosow
