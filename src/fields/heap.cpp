#include "fields/heap.hpp"

#include <algorithm>
#include <cmath>

#include "portable_math/functions.hpp"

namespace vibrosow {
namespace {

constexpr int places = 64, lines = 8;

/// Height of the highest point of the discs over a place of the floor, m; of balls over (x, z). 0 where there is none.
double surface_height(const std::vector<CoveringDisc>& discs, double x, double z, bool is_3d) {
  double highest = 0;
  for (const CoveringDisc& disc : discs) {
    const double along = x - disc.x, across = is_3d ? z - disc.z : 0;
    const double rise2 = disc.radius * disc.radius - along * along - across * across;
    if (rise2 > 0) highest = std::max(highest, disc.y + std::sqrt(rise2));
  }
  return highest;
}

/// Over its middle half: at its edges the heaps' lowest grains may lean out.
bool lies_over(const Snapshot& own, const Hole& hole) {
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own.y[i] > 0 && std::abs(own.x[i] - hole.centre) < 0.25 * hole.width) return true;
  return false;
}

}  // namespace

double surface_slope(const std::vector<CoveringDisc>& discs, const Stretch& stretch) {
  const bool is_3d = stretch.depth > 0;
  const double middle = 0.5 * (stretch.from + stretch.to);
  double product = 0, square = 0;
  for (int line = 0; line < (is_3d ? lines : 1); ++line)
    for (int place = 0; place < places; ++place) {
      const double x = stretch.from + (place + 0.5) / places * (stretch.to - stretch.from);
      const double z = (line + 0.5) / lines * stretch.depth;
      product += (x - middle) * surface_height(discs, x, z, is_3d);
      square += (x - middle) * (x - middle);
    }
  return product / square;
}

std::optional<double> drained_angle(const Snapshot& own, const std::vector<SeedLot>& lots, const Vessel& tray,
                                    double margin) {
  if (tray.holes.size() != 1 || lies_over(own, tray.holes[0])) return std::nullopt;
  const double left_edge = tray.holes[0].centre - 0.5 * tray.holes[0].width;
  const double right_edge = tray.holes[0].centre + 0.5 * tray.holes[0].width;
  if (std::min(left_edge, tray.length - right_edge) < 4 * margin) return std::nullopt;
  const double depth = own.is_3d() ? *tray.depth : 0;
  const std::vector<CoveringDisc> discs = covering_discs(own, lots);
  const double left = surface_slope(discs, {margin, left_edge - margin, depth});
  const double right = surface_slope(discs, {right_edge + margin, tray.length - margin, depth});
  return 0.5 * (portable_math::atan2(right, 1) + portable_math::atan2(-left, 1));
}

}  // namespace vibrosow
