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
  const auto parts = [&](double length) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length / cell)));
  };
  const std::size_t half = parts(0.5 * tray.length), rows = own.is_3d() ? parts(*tray.depth) : 1;
  const auto part = [](double at, double length, std::size_t count) {
    return std::min(static_cast<std::size_t>(at / length * static_cast<double>(count)), count - 1);
  };
  std::vector<double> top(2 * half * rows, 0.0);  // all rows of a column, then the next column to the right
  for (const std::size_t i : grains_in_tray(own, tray)) {
    const std::size_t row = own.is_3d() ? part(own.z[i], *tray.depth, rows) : 0;
    double& height = top[part(own.x[i], tray.length, 2 * half) * rows + row];
    height = std::max(height, own.y[i] + own.radius[i]);
  }
  const auto middle = top.begin() + static_cast<std::ptrdiff_t>(half * rows);
  return asymmetry(std::accumulate(top.begin(), middle, 0.0), std::accumulate(middle, top.end(), 0.0));
}

}  // namespace vibrosow
