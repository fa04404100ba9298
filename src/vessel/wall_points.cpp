#include "vessel/wall_points.hpp"

#include <numbers>
#include <set>

#include "portable_math/functions.hpp"
#include "vessel/vessel_faces.hpp"

namespace vibrosow {
namespace {

using std::numbers::pi;
using Line = std::vector<Eigen::Vector3d>;

constexpr double between_points = pi / 45;

/// About `centre`, from the angle `from` to `to` (rad) from e1 towards e2.
Line arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& e1, const Eigen::Vector3d& e2, double radius,
         double from, double to) {
  const int pieces = 1 + static_cast<int>((to - from) / between_points);
  Line points;
  for (int k = 0; k <= pieces; ++k) {
    const double angle = from + (to - from) * k / pieces;
    const auto [sine, cosine] = portable_math::sine_cosine(angle);
    points.push_back(centre + radius * (cosine * e1 + sine * e2));
  }
  return points;
}

std::vector<Line> lines_of_plate(const Face& face) {
  const Eigen::Vector3d along = face.length_u * face.e1, up = face.length_v * face.e2;
  const Line outline =
      face.round ? arc(face.origin + 0.5 * (along + up), face.e1, face.e2, 0.5 * face.length_u, 0, 2 * pi)
                 : Line{face.origin, face.origin + along, face.origin + along + up, face.origin + up, face.origin};
  std::vector<Line> lines = {outline};
  for (const RoundHole& hole : face.holes)
    lines.push_back(arc(face.origin + hole.u * face.e1 + hole.v * face.e2, face.e1, face.e2, hole.radius, 0, 2 * pi));
  return lines;
}

std::vector<Line> lines_of_revolution(const Face& face) {
  constexpr int between_rims = 8;
  const Line a = arc(face.origin + face.height_a * face.normal, face.e1, face.e2, face.radius_a, -face.half_angle,
                     face.half_angle);
  const Line b = arc(face.origin + face.height_b * face.normal, face.e1, face.e2, face.radius_b, -face.half_angle,
                     face.half_angle);
  std::vector<Line> lines = {a, b};
  for (int k = 0; k < between_rims; ++k) {
    const std::size_t place = static_cast<std::size_t>(k) * (a.size() - 1) / (between_rims - 1);
    lines.push_back({a[place], b[place]});
  }
  return lines;
}

}  // namespace

std::vector<Eigen::Vector2d> wall_points(const WallSegment& wall) {
  if (wall.radius == 0) return {wall.a, wall.b};
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector3d& point : arc({wall.centre.x(), wall.centre.y(), 0}, Eigen::Vector3d::UnitX(),
                                          Eigen::Vector3d::UnitY(), wall.radius, wall.from, wall.to))
    points.push_back(point.head<2>());
  return points;
}

std::vector<Line> face_lines(const Face& face) {
  return face.kind == Face::Kind::plate ? lines_of_plate(face) : lines_of_revolution(face);
}

std::vector<WallSegment> walls_from_the_front(const Vessel& vessel) {
  std::vector<WallSegment> walls = vessel_walls(drawn_once(vessel));
  std::set<double> heights;
  for (const WallPiece& piece : vessel.pieces) {
    if (piece.drawn_out != DrawnOut::along) continue;
    const Extent all = extent({piece});
    heights.insert({all.low.y(), all.high.y()});
  }
  for (const double height : heights) walls.push_back({{0, height}, {vessel.length, height}, "edge", true});
  return walls;
}

BoundingBox reach_of(const Vessel& vessel, Space space) {
  BoundingBox box;
  if (space == Space::two_dimensional) {
    for (const WallSegment& wall : vessel_walls(vessel))
      for (const Eigen::Vector2d& point : wall_points(wall)) box.include(Eigen::Vector3d(point.x(), point.y(), 0));
    return box;
  }
  for (const Face& face : vessel_faces(vessel))
    for (const auto& line : face_lines(face))
      for (const Eigen::Vector3d& point : line) box.include(point);
  return box;
}

Vessel drawn_once(Vessel vessel) {
  for (Sides* sides : {&vessel.sides, &vessel.front_and_back})
    if (*sides == Sides::periodic) *sides = Sides::open;
  return vessel;
}

}  // namespace vibrosow
