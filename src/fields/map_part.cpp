#include "fields/map_part.hpp"

#include <algorithm>

namespace vibrosow {

MapPart map_part(const Scene& scene) {
  if (scene.space == Space::two_dimensional) return {};
  const double depth = *scene.tray.depth;
  if (scene.record->view == MapView::projection) return {0, depth, false};
  const double thickness = std::min(scene.record->cell, depth);
  return {0.5 * (depth - thickness), 0.5 * (depth + thickness), true};
}

std::vector<std::size_t> grains_in(const Snapshot& own, const MapPart& part) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!own.is_3d() || (own.z[i] >= part.front && own.z[i] <= part.back)) inside.push_back(i);
  return inside;
}

}  // namespace vibrosow
