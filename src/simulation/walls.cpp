#include "simulation/walls.hpp"

#include <Eigen/Geometry>

#include "scene/vessel_walls.hpp"
#include "simulation/vessel_motion.hpp"

namespace vibrosow {

std::vector<Vessel> vessels_of(const Scene& scene) {
  std::vector<Vessel> vessels{scene.tray};
  if (scene.hopper) vessels.push_back(*scene.hopper);
  return vessels;
}

Eigen::Vector2d in_lab_frame(const Vessel& vessel, const Eigen::Vector2d& displacement, const Eigen::Vector2d& own) {
  if (vessel.tilt == 0) return vessel.origin + displacement + own;
  return vessel.origin + displacement + Eigen::Rotation2Dd(vessel.tilt) * own;
}

Eigen::Vector2d in_vessel_frame(const Vessel& vessel, const Eigen::Vector2d& displacement, const Eigen::Vector2d& lab) {
  const Eigen::Vector2d moved = lab - vessel.origin - displacement;
  if (vessel.tilt == 0) return moved;
  return Eigen::Rotation2Dd(-vessel.tilt) * moved;
}

Walls::Walls(std::vector<Vessel> vessels) : vessels_(std::move(vessels)), displacement_(vessels_.size()) {
  int first_vertex = 0;
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    const Vessel& vessel = vessels_[v];
    int vertices = 0;
    for (const WallSegment& wall : vessel_walls(vessel)) {
      const Eigen::Vector2d none = Eigen::Vector2d::Zero();
      at_rest_.push_back({in_lab_frame(vessel, none, wall.a), in_lab_frame(vessel, none, wall.b), v});
      placed_.push_back({0, 0, 0, 0, first_vertex + wall.vertex_a, first_vertex + wall.vertex_b, 0, 0});
      vertices = std::max({vertices, wall.vertex_a + 1, wall.vertex_b + 1});
    }
    first_vertex += vertices;
  }
  place(0);
}

void Walls::place(double time) {
  std::vector<Eigen::Vector2d>& moved = displacement_;
  std::size_t next = 0;
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    moved[v] = vessel_displacement(vessels_[v], time);
    const Eigen::Vector2d velocity = vessel_velocity(vessels_[v], time);
    for (; next < placed_.size() && at_rest_[next].vessel == v; ++next) {
      const Eigen::Vector2d a = at_rest_[next].a + moved[v], b = at_rest_[next].b + moved[v];
      PlacedWall& wall = placed_[next];
      wall.ax = a.x(), wall.ay = a.y(), wall.bx = b.x(), wall.by = b.y();
      wall.vx = velocity.x(), wall.vy = velocity.y();
    }
  }
}

}  // namespace vibrosow
