#include "grains/places.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "portable_math/functions.hpp"
#include "vessel/nearest_on_face.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double within_period(double place, double length, Sides sides) {
  return sides == Sides::periodic ? place - length * std::floor(place / length) : place;
}

/// Of a seed that reaches so far either way, m.
double between(double place, double backwards, double forwards, double length, Sides sides) {
  if (sides == Sides::periodic) return within_period(place, length, sides);
  return std::max(backwards, std::min(place, length - forwards));
}

FloorPlace on_floor(const ClumpDisc& ball) {
  return {ball.x, ball.z};
}

/// The largest part of the way from the middle of a round vessel along `arm` that leaves every ball in it; all of them
/// are where the clump lies in the middle.
double part_of_way(const std::vector<ClumpDisc>& balls, const FloorPlace& arm, double vessel_radius) {
  double part = 1;
  for (const ClumpDisc& ball : balls) {
    const FloorPlace own = on_floor(ball);
    const double furthest = vessel_radius - ball.radius;
    if ((arm + own).norm() <= furthest) continue;
    const double along = arm.dot(own), arm2 = arm.squaredNorm();
    const double room2 = std::max(0.0, furthest * furthest - own.squaredNorm());
    part = std::min(part, (std::sqrt(along * along + arm2 * room2) - along) / arm2);
  }
  return part;
}

/// Standing still at the lab's zero, with pieces alone or with its box alone.
Vessel at_zero(const Vessel& vessel, bool box) {
  Vessel own = vessel;
  own.origin.setZero(), own.front = 0, own.tilt = 0, own.motion.reset();
  own.box = box;
  box ? own.pieces.clear() : own.holes.clear();
  if (!box && own.front_and_back == Sides::walls) own.front_and_back = Sides::open;  // no discs of a drum
  return own;
}

bool slopes(const Face& face) {
  if (face.kind == Face::Kind::revolved) return face.radius_a != face.radius_b && face.height_a != face.height_b;
  return face.normal.y() != 0 && face.normal.head<3>().cwiseAbs().y() < 1;
}

}  // namespace

FloorPlace between_ends(const Vessel& vessel, double radius, const FloorPlace& place) {
  if (vessel.plan == Plan::rectangle)
    return {between(place.x(), radius, radius, vessel.length, vessel.sides),
            between(place.y(), radius, radius, *vessel.depth, vessel.front_and_back)};
  const FloorPlace middle = FloorPlace::Constant(0.5 * vessel.length), arm = place - middle;
  const double furthest = 0.5 * vessel.length - radius, distance = arm.norm();
  return distance <= furthest ? place : FloorPlace(middle + furthest / distance * arm);
}

FloorPlace between_ends(const Vessel& vessel, const std::vector<ClumpDisc>& balls, const FloorPlace& place) {
  if (balls.size() == 1) return between_ends(vessel, balls.front().radius, place);
  if (vessel.plan == Plan::round) {
    const FloorPlace middle = FloorPlace::Constant(0.5 * vessel.length), arm = place - middle;
    const double part = part_of_way(balls, arm, 0.5 * vessel.length);
    return part == 1 ? place : FloorPlace(middle + part * arm);
  }
  FloorPlace backwards = FloorPlace::Zero(), forwards = FloorPlace::Zero();
  for (const ClumpDisc& ball : balls) {
    backwards = backwards.cwiseMax(FloorPlace::Constant(ball.radius) - on_floor(ball));
    forwards = forwards.cwiseMax(FloorPlace::Constant(ball.radius) + on_floor(ball));
  }
  return {between(place.x(), backwards.x(), forwards.x(), vessel.length, vessel.sides),
          between(place.y(), backwards.y(), forwards.y(), *vessel.depth, vessel.front_and_back)};
}

FloorPlace within_period(const Vessel& vessel, const FloorPlace& place) {
  return {within_period(place.x(), vessel.length, vessel.sides),
          within_period(place.y(), *vessel.depth, vessel.front_and_back)};
}

FloorPlace random_place(const Vessel& vessel, double radius, Random& random) {
  for (;;) {
    const double x = random.uniform(radius, vessel.length - radius);
    FloorPlace place(x, random.uniform(radius, *vessel.depth - radius));
    if (between_ends(vessel, radius, place) == place) return place;
  }
}

FloorPlace random_place(const Vessel& vessel, double radius, double from, double to, Random& random) {
  double x = random.uniform(from, to);
  double margin = vessel.front_and_back == Sides::walls ? std::min(radius, 0.5 * *vessel.depth) : 0;
  if (vessel.plan == Plan::round) {
    const double middle = 0.5 * vessel.length;
    const auto half_chord = [room = middle - radius, middle](double at) {
      return std::sqrt(std::max(0.0, room * room - (at - middle) * (at - middle)));
    };
    const double longest = half_chord(std::clamp(middle, from, to));
    while (random.uniform() * longest > half_chord(x)) x = random.uniform(from, to);
    margin = middle - half_chord(x);
  }
  return {x, random.uniform(margin, *vessel.depth - margin)};
}

Vessel without_lid(Vessel vessel) {
  constexpr double pi = std::numbers::pi;
  const std::optional<DrumCircle> drum = drum_of(vessel);
  if (!drum) return vessel;
  std::vector<WallPiece> pieces;
  for (const WallPiece& piece : vessel.pieces) {
    if (!is_of_plane(piece) || !drum->has(piece.centre, piece.radius)) {
      pieces.push_back(piece);
      continue;
    }
    // An arc is at most a turn, and begins at any angle.
    const double turns = std::floor(piece.from / (2 * pi)) * 2 * pi;
    for (const double turn : {turns, turns + 2 * pi}) {
      WallPiece lower = piece;
      lower.from = std::max(piece.from, turn + pi), lower.to = std::min(piece.to, turn + 2 * pi);
      if (lower.to - lower.from > 1e-9) pieces.push_back(lower);
    }
  }
  vessel.pieces = std::move(pieces);
  return vessel;
}

Obstacles::Obstacles(const Vessel& vessel, Space space) {
  if (space == Space::two_dimensional) {
    std::ranges::copy_if(vessel_walls(vessel), std::back_inserter(segments_), [](const WallSegment& wall) {
      const Eigen::Vector2d along = wall.b - wall.a;
      return wall.is_piece || (along.x() != 0 && along.y() != 0);
    });
    return;
  }
  pieces_.emplace(std::vector{at_zero(vessel, false)}, Space::three_dimensional);
  for (const PlacedFace& face : pieces_->placed_faces()) faces_.push_back(&face);
  if (vessel.funnel == 0) return;
  funnel_.emplace(std::vector{at_zero(vessel, true)}, Space::three_dimensional);
  for (const PlacedFace& face : funnel_->placed_faces())
    if (slopes(*face.own)) faces_.push_back(&face);
}

double Obstacles::distance(const Eigen::Vector3d& centre) const {
  double nearest = infinite, nearest2 = infinite;
  for (const WallSegment& wall : segments_) nearest = std::min(nearest, distance_to_wall(wall, centre.head<2>()));
  for (const PlacedFace* face : faces_) nearest2 = std::min(nearest2, nearest_on_face(*face, centre).distance2);
  return std::min(nearest, std::sqrt(nearest2));
}

double Obstacles::top() const {
  double top = 0;
  for (const WallSegment& wall : segments_)
    top = std::max({top, wall.a.y(), wall.b.y(), wall.radius > 0 ? wall.centre.y() + wall.radius : 0});
  for (const PlacedFace* placed : faces_) {
    const Face& face = *placed->own;
    const double plate = std::max(0.0, face.length_u * face.e1.y()) + std::max(0.0, face.length_v * face.e2.y());
    const double axis = std::max(face.height_a * face.normal.y(), face.height_b * face.normal.y());
    const double aside = std::max(face.radius_a, face.radius_b) * portable_math::hypot(face.e1.y(), face.e2.y());
    top = std::max(top, face.origin.y() + (face.kind == Face::Kind::plate ? plate : axis + aside));
  }
  return top;
}

double Obstacles::touching_height(const FloorPlace& place, double radius, double from, double least) const {
  if (faces_.empty()) return least;
  constexpr double tolerance = 1e-3;
  // As far as it is free, again and again: nothing is nearer than the nearest.
  double height = from;
  for (double gap = infinite; height > least; height -= gap) {
    gap = distance({place.x(), height, place.y()}) - radius;
    if (height == from && gap < 0) return infinite;
    if (gap <= tolerance * radius) return height;
  }
  return least;
}

}  // namespace vibrosow
