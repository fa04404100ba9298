#include "grains/turned_discs.hpp"

#include <algorithm>
#include <limits>

#include "portable_math/functions.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

std::vector<ClumpDisc> turned_discs(const SeedLot& lot, double size, const Turn& turned) {
  if (lot.discs.empty()) return {{0, 0, 0.5 * size * lot.diameter}};
  std::vector<ClumpDisc> discs;
  discs.reserve(lot.discs.size());
  if (is_solid_clump(lot)) {
    const Eigen::Matrix3d axes = rotation_matrix(turned.orientation);
    for (const ClumpDisc& ball : lot.discs) {
      const Eigen::Vector3d arm = size * (axes * centre_of(ball));
      discs.push_back({arm.x(), arm.y(), size * ball.radius, arm.z()});
    }
    return discs;
  }
  const auto [sine, cosine] = portable_math::sine_cosine(turned.angle);
  for (const ClumpDisc& disc : lot.discs)
    discs.push_back(
        {size * (cosine * disc.x - sine * disc.y), size * (sine * disc.x + cosine * disc.y), size * disc.radius});
  return discs;
}

/// In 3D first about the upright axis, x towards z, then about the axis across, as `point_in_lab` does.
Turn turn_in_lab(const Vessel& vessel, const Pose& pose, const Turn& own) {
  const double angle = vessel.tilt + pose.angle;
  if (angle == 0 && pose.turn == 0) return own;
  const auto [sine, cosine] = portable_math::sine_cosine(0.5 * angle);
  const auto [turn_sine, turn_cosine] = portable_math::sine_cosine(0.5 * pose.turn);
  const Orientation about_z{cosine, 0, 0, sine}, about_y{turn_cosine, 0, -turn_sine, 0};
  return {own.angle + angle, of_unit_length(about_z * (about_y * own.orientation))};
}

const ClumpDisc& thickest(const std::vector<ClumpDisc>& discs) {
  return *std::ranges::max_element(discs, {}, &ClumpDisc::radius);
}

double half_width(const SeedLot& lot, double size) {
  return thickest(turned_discs(lot, size, {})).radius;
}

double least_half_width(const std::vector<SeedLot>& lots) {
  double least = std::numeric_limits<double>::infinity();
  for (const SeedLot& lot : lots) least = std::min(least, half_width(lot, least_size(lot)));
  return least;
}

double most_half_width(const std::vector<SeedLot>& lots) {
  double most = 0;
  for (const SeedLot& lot : lots) most = std::max(most, half_width(lot, most_size(lot)));
  return most;
}

double largest_disc(const std::vector<SeedLot>& lots) {
  double largest = 0;
  for (const SeedLot& lot : lots)
    for (const ClumpDisc& disc : turned_discs(lot, most_size(lot), {})) largest = std::max(largest, 2 * disc.radius);
  return largest;
}

}  // namespace vibrosow
