#include "calibration/repose_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "fields/heap.hpp"
#include "fields/packing_fraction.hpp"
#include "fields/tray_frame.hpp"

namespace vibrosow {
namespace {

/// Diameter (m) of the disc, in 3D the ball, that fills as much as the mean grain.
double mean_diameter(const Snapshot& bed) {
  double extent = 0;
  for (const double one : bed.extent()) extent += one;
  extent /= static_cast<double>(bed.size());
  return bed.is_3d() ? std::cbrt(6 / std::numbers::pi * extent) : std::sqrt(4 / std::numbers::pi * extent);
}

/// Extent (m2 or m3) that left in a second, from the second to the third fifth of all grains that left.
std::optional<double> free_rate(const std::vector<OutflowEvent>& events, const Snapshot& filled) {
  const std::size_t from = events.size() / 5, to = 3 * events.size() / 5;
  if (to < from + 10) return std::nullopt;
  double left = 0;
  for (std::size_t k = from; k < to; ++k) {
    const auto grain = std::ranges::lower_bound(filled.id, events[k].grain);
    left += filled.extent()[static_cast<std::size_t>(grain - filled.id.begin())];
  }
  return left / (events[to].time - events[from].time);
}

}  // namespace

ReposeMetrics repose_metrics(const Scene& scene, const Run& run) {
  if (run.snapshots.size() < 2 || scene.tray.holes.size() != 1)
    throw std::invalid_argument("repose_figures: a run of a box with one hole, filled and drained, is needed");
  const Snapshot filled = in_tray_frame(run.snapshots.front(), scene.tray);
  const Snapshot drained = in_tray_frame(run.snapshots.back(), scene.tray);
  const double diameter = mean_diameter(filled);
  ReposeMetrics metrics;
  metrics.angle = drained_angle(drained, scene.lots, scene.tray, diameter);
  metrics.packing = bed_packing(filled, scene.lots, scene.tray, 2 * diameter);
  if (!metrics.angle || !metrics.packing) return metrics;
  const double depth = filled.is_3d() ? *scene.tray.depth : 1;
  const double unit = *metrics.packing * depth * std::sqrt(standard_gravity) * std::pow(scene.tray.holes[0].width, 1.5);
  if (const auto rate = free_rate(run.events, filled)) metrics.discharge = *rate / unit;
  return metrics;
}

double aspect_ratio(const Scene& scene) {
  const SeedLot& lot = scene.lots.at(0);
  if (lot.discs.empty()) return 1;
  double largest = 0;
  for (const ClumpDisc& disc : lot.discs) largest = std::max(largest, disc.radius);
  return lot.diameter / (2 * largest);
}

}  // namespace vibrosow
