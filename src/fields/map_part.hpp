#pragma once

#include <limits>
#include <vector>

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The part of a bed that its maps are made of: in 2D all of it. In 3D maps lie in the plane of length and
/// height: a projection is of all grains whose centres lie between the tray's front and back, a slice of what lies
/// within half a cell of the middle of the depth, where a grain that reaches out of it is cut.
struct MapPart {
  double front = -std::numeric_limits<double>::infinity();  // m, across, in the tray's frame
  double back = std::numeric_limits<double>::infinity();
  bool cut = false;

  double depth() const { return back - front; }
};

MapPart map_part(const Scene& scene);

/// Indices of the grains whose centres lie in the part. `own`: in the tray's frame.
std::vector<std::size_t> grains_in(const Snapshot& own, const MapPart& part);

}  // namespace vibrosow
