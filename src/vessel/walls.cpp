#include "vessel/walls.hpp"

#include "portable_math/functions.hpp"
#include "vessel/directions.hpp"
#include "vessel/nearest_on_face.hpp"
#include "vessel/nearest_point.hpp"
#include "vessel/vessel_faces.hpp"

namespace vibrosow {

Walls::Walls(std::vector<Vessel> vessels, Space space)
    : vessels_(std::move(vessels)),
      paths_(vessels_.begin(), vessels_.end()),
      shifts_(vessels_.size(), Eigen::Vector2d::Zero()),
      poses_(vessels_.size()) {
  for (std::size_t v = 0; v < vessels_.size(); ++v) space == Space::two_dimensional ? add_segments(v) : add_faces(v);
  for (std::size_t wall = 0; wall < faces_.size(); ++wall) {
    PlacedFace& placed = placed_faces_.emplace_back();
    placed.own = &faces_[wall];
    const auto [sine, cosine] = portable_math::sine_cosine(faces_[wall].half_angle);
    placed.sine_half = sine, placed.cosine_half = cosine;
  }
  place(0);
}

void Walls::add_segments(std::size_t v) {
  const Vessel& vessel = vessels_[v];
  for (const WallSegment& wall : vessel_walls(vessel)) {
    about_.push_back({v, wall.name, wall.opens_at});
    at_rest_.push_back({in_lab_frame(vessel, {}, wall.a), in_lab_frame(vessel, {}, wall.b),
                        in_lab_frame(vessel, {}, wall.centre), wall});
    placed_.emplace_back();
  }
}

void Walls::add_faces(std::size_t v) {
  for (Face& face : vessel_faces(vessels_[v])) {
    about_.push_back({v, face.name, face.opens_at});
    faces_.push_back(std::move(face));
  }
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

double Walls::distance2(std::size_t wall, const Eigen::Vector3d& at) const {
  return placed_faces_.empty() ? nearest_point(placed_[wall], at.x(), at.y()).distance2
                               : nearest_on_face(placed_faces_[wall], at).distance2;
}

std::vector<std::size_t> Walls::named(const std::string& name) const {
  std::vector<std::size_t> walls;
  for (std::size_t wall = 0; wall < about_.size(); ++wall)
    if (about_[wall].name == name) walls.push_back(wall);
  return walls;
}

void Walls::place_arc(PlacedWall& wall, const AtRest& rest, const Vessel& vessel, const Pose& pose) const {
  const Eigen::Vector2d centre =
      pose.angle != 0 ? in_lab_frame(vessel, pose, rest.own.centre) : rest.centre + pose.displacement;
  const double middle = vessel.tilt + pose.angle + 0.5 * (rest.own.from + rest.own.to);
  wall.centre_x = centre.x(), wall.centre_y = centre.y(), wall.radius = rest.own.radius;
  wall.middle_x = portable_math::cos(middle), wall.middle_y = portable_math::sin(middle);
  wall.cos_half = portable_math::cos(0.5 * (rest.own.to - rest.own.from));
}

void Walls::place_segment(std::size_t number, const Driven& now, const Driven& on_mean) {
  const Vessel& vessel = vessels_[about_[number].vessel];
  const Pose& pose = now.pose;
  const auto moving = [&vessel](const Driven& driven) {
    const Eigen::Vector2d at_zero = material_velocity(vessel, driven.pose, driven.rate, Eigen::Vector2d::Zero());
    return PlacedWall::Moving{at_zero.x(), at_zero.y(), driven.rate.angular_velocity};
  };
  const AtRest& rest = at_rest_[number];
  const bool turned = pose.angle != 0;
  const Eigen::Vector2d a = turned ? in_lab_frame(vessel, pose, rest.own.a) : rest.a + pose.displacement;
  const Eigen::Vector2d b = turned ? in_lab_frame(vessel, pose, rest.own.b) : rest.b + pose.displacement;
  PlacedWall& wall = placed_[number];
  wall.ax = a.x(), wall.ay = a.y(), wall.bx = b.x(), wall.by = b.y();
  wall.now = moving(now), wall.on_mean = moving(on_mean);
  if (rest.own.radius > 0) place_arc(wall, rest, vessel, pose);
}

void Walls::place_face(std::size_t number, const Driven& now, const Driven& on_mean) {
  const Vessel& vessel = vessels_[about_[number].vessel];
  const Face& own = faces_[number];
  PlacedFace& face = placed_faces_[number];
  const Pose& pose = now.pose;
  const auto moving = [&vessel](const Driven& driven) {
    return PlacedFace::Moving{point_velocity(vessel, driven.pose, driven.rate, Eigen::Vector3d::Zero()),
                              spin_3d(vessel, driven.pose, driven.rate)};
  };
  face.origin = point_in_lab(vessel, pose, own.origin);
  face.e1 = direction_in_lab(vessel, pose, own.e1);
  face.e2 = direction_in_lab(vessel, pose, own.e2);
  face.normal = direction_in_lab(vessel, pose, own.normal);
  face.now = moving(now), face.on_mean = moving(on_mean);
}

void Walls::place(double time, double lag) {
  std::size_t next = 0;
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    const Driven now = driven(v, time), on_mean = lag == 0 ? now : driven(v, time - lag);
    poses_[v] = now.pose;
    for (; next < about_.size() && about_[next].vessel == v; ++next) {
      if (about_[next].removed) continue;
      faces_.empty() ? place_segment(next, now, on_mean) : place_face(next, now, on_mean);
    }
  }
}

}  // namespace vibrosow
