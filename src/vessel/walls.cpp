#include "vessel/walls.hpp"

#include <algorithm>

#include "elementary/functions.hpp"

namespace vibrosow {

Walls::Walls(std::vector<Vessel> vessels)
    : vessels_(std::move(vessels)),
      paths_(vessels_.begin(), vessels_.end()),
      shifts_(vessels_.size(), Eigen::Vector2d::Zero()),
      poses_(vessels_.size()) {
  int first_vertex = 0;
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    const Vessel& vessel = vessels_[v];
    int vertices = 0;
    for (const WallSegment& wall : vessel_walls(vessel)) {
      at_rest_.push_back({in_lab_frame(vessel, {}, wall.a), in_lab_frame(vessel, {}, wall.b),
                          in_lab_frame(vessel, {}, wall.centre), wall, v});
      placed_.push_back({0, 0, 0, 0, first_vertex + wall.vertex_a, first_vertex + wall.vertex_b, 0, 0});
      vertices = std::max({vertices, wall.vertex_a + 1, wall.vertex_b + 1});
    }
    first_vertex += vertices;
  }
  place(0);
}

void Walls::set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion, const Eigen::Vector2d& shift) {
  vessels_[vessel].motion = motion;
  paths_[vessel] = VesselPath(vessels_[vessel]);
  shifts_[vessel] = shift;
}

Pose Walls::pose(std::size_t vessel, double time) const {
  Pose pose = paths_[vessel].pose(time);
  pose.displacement += shifts_[vessel];
  return pose;
}

std::optional<std::size_t> Walls::find(const std::string& name) const {
  const auto found = std::ranges::find_if(at_rest_, [&](const AtRest& wall) { return wall.own.name == name; });
  if (found == at_rest_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - at_rest_.begin());
}

void Walls::place_arc(PlacedWall& wall, const AtRest& rest, const Pose& pose) const {
  const Vessel& vessel = vessels_[rest.vessel];
  const Eigen::Vector2d centre =
      pose.angle != 0 ? in_lab_frame(vessel, pose, rest.own.centre) : rest.centre + pose.displacement;
  const double middle = vessel.tilt + pose.angle + 0.5 * (rest.own.from + rest.own.to);
  wall.centre_x = centre.x(), wall.centre_y = centre.y(), wall.radius = rest.own.radius;
  wall.middle_x = elementary::cos(middle), wall.middle_y = elementary::sin(middle);
  wall.cos_half = elementary::cos(0.5 * (rest.own.to - rest.own.from));
}

void Walls::place(double time) {
  std::size_t next = 0;
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    const Vessel& vessel = vessels_[v];
    const Pose pose = this->pose(v, time);
    const PoseRate rate = this->rate(v, time);
    poses_[v] = pose;
    // The wall's velocity is stated for the material that passes the lab's zero: at (x, y) it is (vx - spin y, vy +
    // spin x).
    const Eigen::Vector2d velocity = material_velocity(vessel, pose, rate, Eigen::Vector2d::Zero());
    for (; next < placed_.size() && at_rest_[next].vessel == v; ++next) {
      const AtRest& rest = at_rest_[next];
      if (rest.removed) continue;
      const bool turned = pose.angle != 0;
      const Eigen::Vector2d a = turned ? in_lab_frame(vessel, pose, rest.own.a) : rest.a + pose.displacement;
      const Eigen::Vector2d b = turned ? in_lab_frame(vessel, pose, rest.own.b) : rest.b + pose.displacement;
      PlacedWall& wall = placed_[next];
      wall.ax = a.x(), wall.ay = a.y(), wall.bx = b.x(), wall.by = b.y();
      wall.vx = velocity.x(), wall.vy = velocity.y(), wall.spin = rate.angular_velocity;
      if (rest.own.radius > 0) place_arc(wall, rest, pose);
    }
  }
}

}  // namespace vibrosow
