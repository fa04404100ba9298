#include "fields/packing_fraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fields/tray_frame.hpp"
#include "grains/orientation.hpp"
#include "portable_math/functions.hpp"

namespace vibrosow {
namespace {

constexpr double pi = std::numbers::pi;

/// Area of the unit disc left of x = t, |t| <= 1.
double area_left_of(double t) {
  return 0.5 * pi + portable_math::asin(t) + t * std::sqrt(1 - t * t);
}

/// Area of the unit disc left of x = a and below y = b.
double area_left_and_below(double a, double b) {
  a = std::clamp(a, -1.0, 1.0), b = std::clamp(b, -1.0, 1.0);
  if (a * a + b * b < 1)
    return a * b +
           0.5 *
               (a * std::sqrt(1 - a * a) + b * std::sqrt(1 - b * b) + portable_math::asin(a) + portable_math::asin(b)) +
           0.25 * pi;
  if (a > 0 && b > 0) return area_left_of(a) + area_left_of(b) - pi;
  if (a > 0) return area_left_of(b);
  return b > 0 ? area_left_of(a) : 0.0;
}

/// Of the unit ball the part left of x = t, |t| <= r, within the cylinder about z of radius r = sqrt(1 - c^2), c >= 0:
/// the integral of 2 sqrt(1 - x^2 - y^2).
double pillar_left_of(double t, double c) {
  const double y = std::sqrt(std::max(0.0, 1 - c * c - t * t)), c3 = c * c * c;
  return 2 * pi / 3 * (1 - c3) + (t - t * t * t / 3) * (pi - 2 * portable_math::atan2(c, y)) + 2 * c * t * y / 3 -
         4 * c3 / 3 * portable_math::atan2(t, y) + 4.0 / 3 * portable_math::atan2(c * t, y);
}

/// The same left of x = a and below y = b. Where the corner lies within the cylinder it is made of the pillar between
/// the axis and the corner,
/// 2 a b w / 3 + (b - b^3 / 3) atan(a / w) + (a - a^3 / 3) atan(b / w) - 2 / 3 atan(a b / w), w = sqrt(1 - a^2 - b^2),
/// and of halves and a quarter of pillars. (With arc sines of the same angles half the digits would be lost where the
/// corner is near the ball's surface.)
double pillar_left_and_below(double a, double b, double c) {
  const double r = std::sqrt(1 - c * c), whole = 4 * pi / 3 * (1 - c * c * c);
  a = std::clamp(a, -r, r), b = std::clamp(b, -r, r);
  if (a * a + b * b >= r * r) {
    if (a > 0 && b > 0) return pillar_left_of(a, c) + pillar_left_of(b, c) - whole;
    if (a > 0) return pillar_left_of(b, c);
    return b > 0 ? pillar_left_of(a, c) : 0.0;
  }
  const double w = std::sqrt(std::max(0.0, 1 - a * a - b * b));
  const double corner = 2 * a * b * w / 3 + (b - b * b * b / 3) * portable_math::atan2(a, w) +
                        (a - a * a * a / 3) * portable_math::atan2(b, w) - 2.0 / 3 * portable_math::atan2(a * b, w);
  return corner + 0.5 * (pillar_left_of(a, c) + pillar_left_of(b, c)) - 0.25 * whole;
}

/// Volume of the unit ball left of x = a, below y = b and between z = 0 and z = c; less than 0 for c < 0. Within the
/// cylinder in which the plane z = c cuts the ball it is as high as c, outside of it as high as the ball.
double ball_up_to(double a, double b, double c) {
  const double top = std::min(1.0, std::abs(c)), r = std::sqrt(1 - top * top);
  const double under = r > 0 ? top * (r * r) * area_left_and_below(a / r, b / r) : 0;
  const double outside = pillar_left_and_below(a, b, 0) - pillar_left_and_below(a, b, top);
  return std::copysign(under + 0.5 * outside, c);
}

/// Height over the tray's floor under which the centres of a fraction of the grains' area lie, m; 0 for an empty tray.
double height_holding(const Snapshot& own, const Vessel& tray, double fraction) {
  std::vector<std::size_t> inside = grains_in_tray(own, tray);
  std::ranges::stable_sort(inside, {}, [&](std::size_t i) { return own.y[i]; });
  const std::vector<double>& extent = own.extent();
  double all = 0;
  for (const std::size_t i : inside) all += extent[i];
  double below = 0;
  for (const std::size_t i : inside) {
    below += extent[i];
    if (below >= fraction * all) return own.y[i];
  }
  return 0;
}

/// What a disc has in common with the rectangle from `low` to `high`, m from its centre, in m2; in 3D a ball with
/// that rectangle through the depth of `part`, in m3.
double covered_of(const CoveringDisc& disc, const Eigen::Vector2d& low, const Eigen::Vector2d& high, bool is_3d,
                  const MapPart& part) {
  if (!is_3d) return disc.fraction * disc_in_rectangle(disc.radius, low, high);
  if (!part.cut && (disc.z < part.front || disc.z > part.back)) return 0;
  const double infinity = std::numeric_limits<double>::infinity();
  const double front = part.cut ? part.front - disc.z : -infinity, back = part.cut ? part.back - disc.z : infinity;
  return disc.fraction * ball_in_box(disc.radius, {low.x(), low.y(), front}, {high.x(), high.y(), back});
}

void add_balls_of_clump(const Snapshot& s, const SeedLot& lot, std::size_t i, std::vector<CoveringDisc>& covering) {
  const double size = 2 * s.radius[i] / lot.diameter;
  const Eigen::Matrix3d turn = rotation_matrix({s.q_w[i], s.q_x[i], s.q_y[i], s.q_z[i]});
  double volume = 0;
  for (const ClumpDisc& ball : lot.discs) volume += 4 * pi / 3 * portable_math::pow(size * ball.radius, 3);
  for (const ClumpDisc& ball : lot.discs) {
    const Eigen::Vector3d arm = size * (turn * centre_of(ball));
    covering.push_back(
        {s.x[i] + arm.x(), s.y[i] + arm.y(), size * ball.radius, s.volume[i] / volume, s.z[i] + arm.z()});
  }
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

double ball_in_box(double radius, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const Eigen::Vector3d a = low / radius, b = high / radius;
  const auto nearest = [&](int axis) { return std::clamp(0.0, a[axis], b[axis]); };
  if (nearest(0) * nearest(0) + nearest(1) * nearest(1) + nearest(2) * nearest(2) >= 1) return 0;
  const auto up_to = [&](double c) {
    return ball_up_to(b.x(), b.y(), c) - ball_up_to(a.x(), b.y(), c) - ball_up_to(b.x(), a.y(), c) +
           ball_up_to(a.x(), a.y(), c);
  };
  return std::max(0.0, up_to(b.z()) - up_to(a.z())) * (radius * radius * radius);
}

std::vector<CoveringDisc> covering_discs(const Snapshot& snapshot, const std::vector<SeedLot>& lots) {
  std::vector<CoveringDisc> covering;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const auto lot = static_cast<std::size_t>(snapshot.lot[i]);
    if ((snapshot.angle.empty() && snapshot.q_w.empty()) || lots[lot].discs.empty()) {
      covering.push_back({snapshot.x[i], snapshot.y[i], snapshot.radius[i], 1, snapshot.is_3d() ? snapshot.z[i] : 0});
      continue;
    }
    if (snapshot.is_3d()) {
      add_balls_of_clump(snapshot, lots[lot], i, covering);
      continue;
    }
    const double size = 2 * snapshot.radius[i] / lots[lot].diameter;
    const auto turn = portable_math::sine_cosine(snapshot.angle[i]);
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

std::vector<double> packing_fraction(const Snapshot& snapshot, const std::vector<SeedLot>& lots, const Grid& grid,
                                     const MapPart& part) {
  std::vector<double> fraction(grid.size(), 0.0);
  const bool is_3d = snapshot.is_3d();
  const double cell = grid.cell * grid.cell * (is_3d ? part.depth() : 1);
  const auto place = [&](double at, std::int64_t first, std::int64_t count) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at / grid.cell)) - first, -1, count);
  };
  for (const CoveringDisc& disc : covering_discs(snapshot, lots)) {
    const auto [x, y, r] = std::array{disc.x, disc.y, disc.radius};
    const std::int64_t left = std::max<std::int64_t>(0, place(x - r, grid.first_column, grid.columns));
    const std::int64_t right = std::min(grid.columns - 1, place(x + r, grid.first_column, grid.columns));
    const std::int64_t bottom = std::max<std::int64_t>(0, place(y - r, grid.first_row, grid.rows));
    const std::int64_t top = std::min(grid.rows - 1, place(y + r, grid.first_row, grid.rows));
    for (std::int64_t row = bottom; row <= top; ++row)
      for (std::int64_t column = left; column <= right; ++column) {
        const std::size_t k = grid.index(column, row);
        const Eigen::Vector2d low = grid.lower_left(k) - Eigen::Vector2d(x, y);
        const Eigen::Vector2d high = low + Eigen::Vector2d::Constant(grid.cell);
        fraction[k] += covered_of(disc, low, high, is_3d, part) / cell;
      }
  }
  return fraction;
}

std::optional<double> bed_packing(const Snapshot& own, const std::vector<SeedLot>& lots, const Vessel& tray,
                                  double margin) {
  const Eigen::Vector2d low(0.25 * tray.length, margin);
  const Eigen::Vector2d high(0.75 * tray.length, height_holding(own, tray, 0.75));
  if ((high - low).minCoeff() <= 0) return std::nullopt;
  const bool is_3d = own.is_3d();
  const MapPart part = is_3d ? MapPart{0.25 * *tray.depth, 0.75 * *tray.depth, true} : MapPart{};
  double covered = 0;
  for (const CoveringDisc& disc : covering_discs(own, lots)) {
    const Eigen::Vector2d centre(disc.x, disc.y);
    covered += covered_of(disc, low - centre, high - centre, is_3d, part);
  }
  return covered / (high - low).prod() / (is_3d ? part.depth() : 1);
}

std::vector<double> packing_change(const Snapshot& before, const Snapshot& after, const std::vector<SeedLot>& lots,
                                   const Grid& grid, const MapPart& part) {
  std::vector<double> change = packing_fraction(after, lots, grid, part);
  const std::vector<double> earlier = packing_fraction(before, lots, grid, part);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= earlier[k];
  return change;
}

}  // namespace vibrosow
