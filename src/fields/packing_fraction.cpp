#include "fields/packing_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary/functions.hpp"
#include "fields/tray_frame.hpp"

namespace vibrosow {
namespace {

constexpr double pi = std::numbers::pi;

/// Area of the unit disc left of x = t, |t| <= 1.
double area_left_of(double t) {
  return 0.5 * pi + elementary::asin(t) + t * std::sqrt(1 - t * t);
}

/// Area of the unit disc left of x = a and below y = b.
double area_left_and_below(double a, double b) {
  a = std::clamp(a, -1.0, 1.0), b = std::clamp(b, -1.0, 1.0);
  if (a * a + b * b < 1)
    return a * b +
           0.5 * (a * std::sqrt(1 - a * a) + b * std::sqrt(1 - b * b) + elementary::asin(a) + elementary::asin(b)) +
           0.25 * pi;
  if (a > 0 && b > 0) return area_left_of(a) + area_left_of(b) - pi;
  if (a > 0) return area_left_of(b);
  return b > 0 ? area_left_of(a) : 0.0;
}

/// Height over the tray's floor under which the centres of a fraction of the grains' area lie, m; 0 for an empty tray.
double height_holding(const Snapshot& own, const Vessel& tray, double fraction) {
  std::vector<std::size_t> inside = grains_in_tray(own, tray);
  std::ranges::stable_sort(inside, {}, [&](std::size_t i) { return own.y[i]; });
  double area = 0;
  for (const std::size_t i : inside) area += own.area[i];
  double below = 0;
  for (const std::size_t i : inside)
    if ((below += own.area[i]) >= fraction * area) return own.y[i];
  return 0;
}

}  // namespace

double disc_in_rectangle(double radius, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const Eigen::Vector2d a = low / radius, b = high / radius;
  const Eigen::Vector2d nearest(std::clamp(0.0, a.x(), b.x()), std::clamp(0.0, a.y(), b.y()));
  if (nearest.squaredNorm() >= 1) return 0;  // exactly, without a rounding error left over
  const double area = area_left_and_below(b.x(), b.y()) - area_left_and_below(a.x(), b.y()) -
                      area_left_and_below(b.x(), a.y()) + area_left_and_below(a.x(), a.y());
  return std::max(0.0, area) * radius * radius;
}

std::vector<CoveringDisc> covering_discs(const Snapshot& snapshot, const std::vector<SeedLot>& lots) {
  std::vector<CoveringDisc> covering;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const auto lot = static_cast<std::size_t>(snapshot.lot[i]);
    if (snapshot.angle.empty() || lots[lot].discs.empty()) {
      covering.push_back({snapshot.x[i], snapshot.y[i], snapshot.radius[i], 1});
      continue;
    }
    const double size = 2 * snapshot.radius[i] / lots[lot].diameter;
    const auto turn = elementary::sine_cosine(snapshot.angle[i]);
    const double cosine = size * turn.cosine, sine = size * turn.sine;
    double area = 0;
    for (const ClumpDisc& disc : lots[lot].discs) area += pi * disc.radius * disc.radius * size * size;
    for (const ClumpDisc& disc : lots[lot].discs)
      covering.push_back({snapshot.x[i] + cosine * disc.x - sine * disc.y,
                          snapshot.y[i] + sine * disc.x + cosine * disc.y, size * disc.radius,
                          snapshot.area[i] / area});
  }
  return covering;
}

std::vector<double> packing_fraction(const Snapshot& snapshot, const std::vector<SeedLot>& lots, const Grid& grid) {
  std::vector<double> fraction(grid.size(), 0.0);
  const auto place = [&](double at, std::int64_t first, std::int64_t count) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at / grid.cell)) - first, -1, count);
  };
  for (const auto& [x, y, r, counted] : covering_discs(snapshot, lots)) {
    const std::int64_t left = std::max<std::int64_t>(0, place(x - r, grid.first_column, grid.columns));
    const std::int64_t right = std::min(grid.columns - 1, place(x + r, grid.first_column, grid.columns));
    const std::int64_t bottom = std::max<std::int64_t>(0, place(y - r, grid.first_row, grid.rows));
    const std::int64_t top = std::min(grid.rows - 1, place(y + r, grid.first_row, grid.rows));
    for (std::int64_t row = bottom; row <= top; ++row)
      for (std::int64_t column = left; column <= right; ++column) {
        const std::size_t k = grid.index(column, row);
        const Eigen::Vector2d low = grid.lower_left(k) - Eigen::Vector2d(x, y);
        const Eigen::Vector2d high = low + Eigen::Vector2d::Constant(grid.cell);
        fraction[k] += counted * disc_in_rectangle(r, low, high) / (grid.cell * grid.cell);
      }
  }
  return fraction;
}

std::optional<double> bed_packing(const Snapshot& own, const std::vector<SeedLot>& lots, const Vessel& tray,
                                  double margin) {
  const Eigen::Vector2d low(0.25 * tray.length, margin);
  const Eigen::Vector2d high(0.75 * tray.length, height_holding(own, tray, 0.75));
  if ((high - low).minCoeff() <= 0) return std::nullopt;
  double covered = 0;
  for (const auto& [x, y, r, counted] : covering_discs(own, lots)) {
    const Eigen::Vector2d centre(x, y);
    covered += counted * disc_in_rectangle(r, low - centre, high - centre);
  }
  return covered / (high - low).prod();
}

std::vector<double> packing_change(const Snapshot& before, const Snapshot& after, const std::vector<SeedLot>& lots,
                                   const Grid& grid) {
  std::vector<double> change = packing_fraction(after, lots, grid);
  const std::vector<double> earlier = packing_fraction(before, lots, grid);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= earlier[k];
  return change;
}

}  // namespace vibrosow
