#include "vessel/hopper_images.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/bounding_box.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

struct Periods {
  double along = 0, across = 0;  // m; 0: the hopper has no images there
};

Periods periods_of(const Scene& scene) {
  if (!scene.hopper) return {};
  const bool along = scene.tray.sides == Sides::periodic;
  const bool across = scene.space == Space::three_dimensional && scene.tray.front_and_back == Sides::periodic &&
                      scene.hopper->front_and_back != Sides::periodic;
  return {along ? scene.tray.length : 0, across ? *scene.tray.depth : 0};
}

/// At rest, where the tray's own frame begins.
BoundingBox reach_over_tray(const Scene& scene) {
  const BoundingBox own = reach_of(*scene.hopper, scene.space);
  const Eigen::Vector3d tray(scene.tray.origin.x(), scene.tray.origin.y(), scene.tray.front);
  BoundingBox over;
  for (int k = 0; k < 8; ++k) over.include(point_in_lab(*scene.hopper, {}, own.corner(k)) - tray);
  return over;
}

/// Of the period (m) along or across that a hopper takes however it stands. One that leans clears its image where what
/// separates them leans as well; of one that turns it is the circle.
double period_taken(const Vessel& hopper, const Eigen::Vector3d& size, bool along) {
  const double leans = std::abs(hopper.tilt) + motion_bounds(hopper).angle;
  const double in_plan = portable_math::hypot(size.x(), size.z()), upright = portable_math::hypot(size.x(), size.y());
  const bool turns_upright = turns_steadily(hopper) && !turns_over(hopper);
  if (!along) return turns_upright ? in_plan : size.z();
  if (turns_upright) return in_plan / portable_math::cos(leans);
  return leans < 0.5 * std::numbers::pi ? std::min(size.x() / portable_math::cos(leans), upright) : upright;
}

double largest_lot(const Scene& scene) {
  double diameter = 0;
  for (const SeedLot& lot : scene.lots) diameter = std::max(diameter, lot.diameter);
  return diameter;
}

double moved_apart(const Scene& scene) {
  return motion_bounds(scene.tray).displacement + motion_bounds(*scene.hopper).displacement;
}

/// How far beyond a side of the tray a grain may touch a wall, where it is carried over beyond `side`, m.
double touched_beyond(const Scene& scene, double side) {
  return side + moved_apart(scene) + largest_diameter(scene.lots);
}

/// Whether all that a grain can come to lies within the period to either side, of hoppers from `from` to `to` (m) over
/// the tray.
bool have_walls(const Scene& scene, double from, double to, double period) {
  const double beyond = touched_beyond(scene, carried_beyond(scene));
  return from + 2 * period >= period + beyond && to - 2 * period <= -beyond;
}

}  // namespace

std::vector<Vessel> hopper_images(const Scene& scene) {
  const auto [along, across] = periods_of(scene);
  const int most_x = along > 0 ? 1 : 0, most_z = across > 0 ? 1 : 0;
  std::vector<Vessel> images;
  for (int i = -most_x; i <= most_x; ++i)
    for (int k = -most_z; k <= most_z; ++k) {
      if (i == 0 && k == 0) continue;
      Vessel& image = images.emplace_back(*scene.hopper);
      image.fill.reset(), image.rain.reset();
      image.origin.x() += i * along, image.front += k * across;
    }
  return images;
}

std::optional<ImageFault> image_fault(const Scene& scene) {
  constexpr double rounding = 1e-9;
  const auto [along, across] = periods_of(scene);
  if (along == 0 && across == 0) return std::nullopt;
  const Vessel& hopper = *scene.hopper;
  const double left = hopper.origin.x() - scene.tray.origin.x();
  if (along > 0 && !(left >= -rounding * along && left + hopper.length <= along * (1 + rounding)))
    return ImageFault{"left", "the hopper does not lie within the length of the periodic tray"};
  const BoundingBox own = reach_of(hopper, scene.space);
  const Eigen::Vector3d size = own.high - own.low;
  const BoundingBox over = reach_over_tray(scene);
  for (const bool is_along : {true, false}) {
    const double period = is_along ? along : across;
    if (period == 0) continue;
    const int axis = is_along ? 0 : 2;
    const double taken = period_taken(hopper, size, is_along);
    if (taken > period * (1 + rounding))
      return ImageFault{is_along ? "length" : "depth",
                        fmt::format("the hopper, as it leans and turns and with its pieces, takes {:.4g} mm {} a "
                                    "periodic tray of {:.4g} mm: it would pass through the hopper of the next period",
                                    1e3 * taken, is_along ? "along" : "across", 1e3 * period)};
    if (!have_walls(scene, over.low[axis], over.high[axis], period))
      return ImageFault{"motion",
                        fmt::format("tray and hopper move by up to {:.4g} mm against each other, too far for a period "
                                    "of {:.4g} mm",
                                    1e3 * moved_apart(scene), 1e3 * period)};
  }
  return std::nullopt;
}

double carried_beyond(const Scene& scene) {
  const double diameter = largest_lot(scene);
  const Periods periods = periods_of(scene);
  if (periods.along == 0 && periods.across == 0) return diameter;
  double farther = diameter + moved_apart(scene);
  for (const double period : {periods.along, periods.across})
    if (period > 0) farther = std::min(farther, diameter + 0.25 * period);
  const double beyond = touched_beyond(scene, farther);
  const BoundingBox over = reach_over_tray(scene);
  const auto is_near = [&](int axis, double period) {
    return period > 0 && (over.low[axis] < beyond || over.high[axis] > period - beyond);
  };
  return is_near(0, periods.along) || is_near(2, periods.across) ? farther : diameter;
}

}  // namespace vibrosow
