#include "simulation/seed_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compute/nearest_image.hpp"
#include "grains/turned_discs.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

Turn turn_of(const Grains& grains, std::size_t i) {
  Turn turn;
  if (!grains.oriented) return turn;
  if (grains.is_3d)
    turn.orientation = grains.orientation(i);
  else
    turn.angle = grains.angle[i];
  return turn;
}

Eigen::Vector3d arm(const ClumpDisc& ball) {
  return {ball.x, ball.y, ball.z};
}

/// Whether a hopper lies so over a tray that seeds come past it along the tray alone: it leaves no gap to the front or
/// to the back that the smallest passes.
bool is_as_deep(const Vessel& tray, const Vessel& hopper, const Scene& scene) {
  if (scene.space == Space::two_dimensional) return true;
  const double gap = 2 * least_half_width(scene.lots), front = hopper.front - tray.front;
  return hopper.plan == Plan::rectangle && tray.plan == Plan::rectangle && front < gap &&
         *tray.depth - front - *hopper.depth < gap;
}

/// A tray with the walls of a hopper for pieces, its outlets closed.
Vessel with_hopper(Vessel tray, const Vessel& hopper) {
  const Pose of_tray = vessel_pose(tray, 0), of_hopper = vessel_pose(hopper, 0);
  const double turn = hopper.tilt + of_hopper.angle - tray.tilt - of_tray.angle;
  const auto in_tray = [&](const Eigen::Vector2d& own) {
    return in_vessel_frame(tray, of_tray, in_lab_frame(hopper, of_hopper, own));
  };
  std::vector<WallPiece> pieces;
  for (const WallSegment& wall : vessel_walls(hopper))
    pieces.push_back({.a = in_tray(wall.a),
                      .b = in_tray(wall.b),
                      .centre = in_tray(wall.centre),
                      .radius = wall.radius,
                      .from = wall.from + turn,
                      .to = wall.to + turn});
  for (const Hole& hole : hopper.holes)
    pieces.push_back(
        {.a = in_tray({hole.centre - 0.5 * hole.width, 0}), .b = in_tray({hole.centre + 0.5 * hole.width, 0})});
  tray.pieces.insert(tray.pieces.end(), pieces.begin(), pieces.end());
  return tray;
}

}  // namespace

SeedPlaces::SeedPlaces(const Model& model) : model_(model) {
  for (const Vessel& vessel : model.vessels) rooms_.emplace_back(vessel, model.scene.lots, model.scene.space);
  const Vessel& tray = model.vessels.front();
  const auto is_fed = [](const Vessel& vessel) { return is_kept(vessel) || vessel.rain; };
  if (model.vessels.size() > 1 && is_fed(tray) && tray.box && !turns_steadily(tray) &&
      !turns_steadily(model.vessels[1]) && is_as_deep(tray, model.vessels[1], model.scene))
    beside_hopper_.emplace(with_hopper(tray, model.vessels[1]), model.scene.lots, model.scene.space);
  if (tray.sides == Sides::periodic) along_ = tray.length;
  if (model.scene.space == Space::three_dimensional && tray.front_and_back == Sides::periodic) across_ = *tray.depth;
}

Eigen::Vector3d SeedPlaces::own_place(const Eigen::Vector3d& at, std::size_t v, const Walls& walls) const {
  return point_in_vessel(model_.vessels[v], walls.poses()[v], at);
}

bool SeedPlaces::is_in_room(const Eigen::Vector3d& at, double half_width, std::size_t v, const Walls& walls) const {
  const Vessel& vessel = model_.vessels[v];
  const FreeRoom& room = rooms_[v].of(half_width);
  const auto holds = [&](const Pose& pose, bool upright) {
    Eigen::Vector3d own = point_in_vessel(vessel, pose, at);
    if (upright && own.y() > vessel.height)  // from there it falls straight down
      own -= aside_while_rising(vessel, pose, own.y() - vessel.height);
    return room.holds(own);
  };
  const Pose& pose = walls.poses()[v];
  if (holds(pose, !turns_over(vessel) && stands(vessel, pose))) return true;
  return turns_over(vessel) && !drum_of(vessel) && holds({}, true);
}

std::string SeedPlaces::unseen_ways(std::size_t v) const {
  const std::optional<double> missed = rooms_[v].of_smallest().missed_width();
  if (!missed) return "";
  return fmt::format(" (ways narrower than {:.3g} mm are not looked for in a {} so large for its seeds)", 1e3 * *missed,
                     model_.vessels[v].name);
}

bool SeedPlaces::lies_in_hopper_within(const Eigen::Vector3d& at, std::size_t v, const Walls& walls) const {
  for (std::size_t other = v + 1; other < rooms_.size(); ++other)
    if (rooms_[other].of_smallest().holds_below_top(own_place(at, other, walls))) return true;
  return false;
}

bool SeedPlaces::belong(const Eigen::Vector3d& at, double half_width, std::size_t v, const Walls& walls) const {
  const bool beside = v == 0 && beside_hopper_;
  return is_in_room(at, half_width, v, walls) && !lies_in_hopper_within(at, v, walls) &&
         (!beside || beside_hopper_->of(half_width).holds(own_place(at, v, walls)));
}

bool SeedPlaces::counts_in(const Eigen::Vector3d& at, std::size_t v, const Walls& walls) const {
  return (v == 0 || is_in_room(at, 0, v, walls)) && !lies_in_hopper_within(at, v, walls);
}

double SeedPlaces::depth_in_walls(const Eigen::Vector3d& at, double radius, const Walls& walls) const {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t wall = 0; wall < walls.count(); ++wall)
    if (!walls.is_removed(wall)) nearest2 = std::min(nearest2, walls.distance2(wall, at));
  return radius - std::sqrt(nearest2);
}

/// From a place to a grain, or the nearest of its images, m.
Eigen::Vector3d SeedPlaces::apart(const Grains& grains, std::size_t i, const Eigen::Vector3d& at) const {
  Eigen::Vector3d apart = grains.place(i) - at;
  if (along_ > 0) apart.x() = nearest_image(apart.x(), along_);
  if (across_ > 0) apart.z() = nearest_image(apart.z(), across_);
  return apart;
}

bool SeedPlaces::is_clear_of_grains(const Eigen::Vector3d& at, double radius, const Grains& grains) const {
  constexpr double clearance = 1.01;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double reach = clearance * (radius + grains.kind(i).radius);
    if (apart(grains, i, at).squaredNorm() < reach * reach) return false;
  }
  return true;
}

std::vector<ClumpDisc> SeedPlaces::balls_of(const Grains& grains, std::size_t i) const {
  const SeedLot& lot = model_.scene.lots[static_cast<std::size_t>(grains.lot[i])];
  return turned_discs(lot, 2 * grains.kind(i).radius / lot.diameter, turn_of(grains, i));
}

std::optional<std::string> SeedPlaces::overlapped_grain(const Grains& grains, std::size_t i) const {
  const Eigen::Vector3d at = grains.place(i);
  const double radius = grains.kind(i).radius;
  const std::vector<ClumpDisc> balls = balls_of(grains, i);
  for (std::size_t j = 0; j < grains.size(); ++j) {
    const Eigen::Vector3d between = apart(grains, j, at);
    if (j == i || between.norm() >= radius + grains.kind(j).radius) continue;
    for (const ClumpDisc& other : balls_of(grains, j))
      for (const ClumpDisc& ball : balls) {
        const double overlap = ball.radius + other.radius - (between + arm(other) - arm(ball)).norm();
        if (overlap > most_placing_overlap * ball.radius)
          return fmt::format("lies {:.3g} of its radius deep in grain {}", overlap / ball.radius, grains.id[j]);
      }
  }
  return std::nullopt;
}

double SeedPlaces::relative_depth_in_walls(const Grains& grains, std::size_t i, const Walls& walls) const {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ClumpDisc& ball : balls_of(grains, i))
    deepest = std::max(deepest, depth_in_walls(grains.place(i) + arm(ball), ball.radius, walls) / ball.radius);
  return deepest;
}

std::optional<std::string> SeedPlaces::fault_among_walls(const Grains& grains, std::size_t i, std::size_t vessel,
                                                         const Walls& walls) const {
  const double depth = relative_depth_in_walls(grains, i, walls);
  if (depth > most_placing_overlap) return fmt::format("lies {:.3g} of its radius deep in a wall", depth);
  // Where the centre is in a gap of a clump, its thickest ball says where it is; over an open side that may hang out.
  const ClumpDisc ball = thickest(balls_of(grains, i));
  const Eigen::Vector3d centre = grains.place(i);
  const bool all_known = !rooms_[vessel].of(ball.radius).missed_width();
  if (all_known && !is_in_room(centre + arm(ball), ball.radius, vessel, walls) &&
      !is_in_room(centre, ball.radius, vessel, walls))
    return "lies where no seed comes to from the top of the " + model_.vessels[vessel].name;
  return std::nullopt;
}

std::optional<std::string> SeedPlaces::fault(const Grains& grains, std::size_t i, std::size_t vessel,
                                             const Walls& walls) const {
  const std::optional<std::string> in_grain = overlapped_grain(grains, i);
  return in_grain ? in_grain : fault_among_walls(grains, i, vessel, walls);
}

std::string placing_fault(const Model& model, const Grains& grains, std::size_t i, const std::string& fault) {
  return fmt::format("{} was put in wrongly: it {}; a fault of how the program places seeds, not of the step",
                     grain_text(model, grains, i), fault);
}

std::string grain_text(const Model& model, const Grains& grains, std::size_t i) {
  const std::string& lot = model.scene.lots[static_cast<std::size_t>(grains.lot[i])].name;
  const std::string across = grains.is_3d ? fmt::format(", z {:.4g} mm", 1e3 * grains.z[i]) : "";
  return fmt::format("grain {} ({}) at x {:.4g} mm, y {:.4g} mm{}", grains.id[i], lot, 1e3 * grains.x[i],
                     1e3 * grains.y[i], across);
}

}  // namespace vibrosow
