#include "fields/asymmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fields/tray_frame.hpp"

namespace vibrosow {
namespace {

std::optional<double> asymmetry(double left, double right) {
  if (left + right <= 0) return std::nullopt;
  return (left - right) / (left + right);
}

}  // namespace

std::optional<double> flux_asymmetry(const Snapshot& own, const Vessel& tray) {
  double left = 0, right = 0;
  for (const std::size_t i : grains_in_tray(own, tray))
    (own.x[i] < 0.5 * tray.length ? left : right) += own.mass[i] * std::max(0.0, -own.vy[i]);
  return asymmetry(left, right);
}

std::optional<double> surface_asymmetry(const Snapshot& own, const Vessel& tray, double cell) {
  const auto half = static_cast<std::ptrdiff_t>(std::max(1.0, std::round(0.5 * tray.length / cell)));
  std::vector<double> top(static_cast<std::size_t>(2 * half), 0.0);
  for (const std::size_t i : grains_in_tray(own, tray)) {
    const auto column = static_cast<std::size_t>(own.x[i] / tray.length * static_cast<double>(2 * half));
    double& height = top[std::min(column, top.size() - 1)];
    height = std::max(height, own.y[i] + own.radius[i]);
  }
  return asymmetry(std::accumulate(top.begin(), top.begin() + half, 0.0),
                   std::accumulate(top.begin() + half, top.end(), 0.0));
}

}  // namespace vibrosow
