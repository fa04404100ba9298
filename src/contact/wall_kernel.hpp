#pragma once

#include <array>
#include <cmath>

#include "contact/kernels.hpp"

namespace vibrosow {

/// The nearest point of a wall to a grain's centre.
struct NearestPoint {
  double dx, dy;     // m, from the centre to the point
  double distance2;  // m2
  int vertex;        // number of the end point it is; -1 inside the segment (a face)
  double side;       // sign tells the side of the wall's line: left of a to b, or outside an arc's circle
};

inline NearestPoint nearest_on_arc(const PlacedWall& wall, double x, double y) {
  const double rx = x - wall.centre_x, ry = y - wall.centre_y;
  const double r = std::sqrt(rx * rx + ry * ry), side = r - wall.radius;
  double px = wall.centre_x + wall.radius * wall.middle_x, py = wall.centre_y + wall.radius * wall.middle_y;
  int vertex = -1;
  if (r > 0 && rx * wall.middle_x + ry * wall.middle_y > r * wall.cos_half) {
    px = wall.centre_x + wall.radius * rx / r, py = wall.centre_y + wall.radius * ry / r;
  } else if (r > 0) {
    const double to_a = std::hypot(x - wall.ax, y - wall.ay), to_b = std::hypot(x - wall.bx, y - wall.by);
    vertex = to_a <= to_b ? wall.vertex_a : wall.vertex_b;
    px = to_a <= to_b ? wall.ax : wall.bx, py = to_a <= to_b ? wall.ay : wall.by;
  }
  const double dx = px - x, dy = py - y;
  return {dx, dy, dx * dx + dy * dy, vertex, side};
}

inline NearestPoint nearest_point(const PlacedWall& wall, double x, double y) {
  if (wall.radius > 0) return nearest_on_arc(wall, x, y);
  const double ex = wall.bx - wall.ax, ey = wall.by - wall.ay;
  const double rx = x - wall.ax, ry = y - wall.ay;
  const double along = (rx * ex + ry * ey) / (ex * ex + ey * ey);
  const double side = ex * ry - ey * rx;
  const int vertex = along <= 0 ? wall.vertex_a : along >= 1 ? wall.vertex_b : -1;
  const double px = along <= 0 ? wall.ax : along >= 1 ? wall.bx : wall.ax + along * ex;
  const double py = along <= 0 ? wall.ay : along >= 1 ? wall.by : wall.ay + along * ey;
  const double dx = px - x, dy = py - y;
  return {dx, dy, dx * dx + dy * dy, vertex, side};
}

/// Calls `touch(wall, nearest)` for each contact of grain `i`, which owns candidates [from, to): faces first, then each
/// end point once and only where no touched face ends in it.
template <class Touch>
void for_each_wall_contact(const std::vector<WallCandidate>& candidates, std::size_t from, std::size_t to,
                           const std::vector<PlacedWall>& walls, double x, double y, double radius, Touch touch) {
  constexpr std::size_t most = 32;  // end points met at once: many more than a plane corner can have
  std::array<int, most> covered{};
  std::size_t covered_count = 0;
  const auto cover = [&](int vertex) {
    if (covered_count < most) covered[covered_count++] = vertex;
  };
  const auto is_covered = [&](int vertex) {
    for (std::size_t k = 0; k < covered_count; ++k)
      if (covered[k] == vertex) return true;
    return false;
  };
  for (const bool faces : {true, false}) {
    for (std::size_t c = from; c < to; ++c) {
      const PlacedWall& wall = walls[static_cast<std::size_t>(candidates[c].wall)];
      const NearestPoint nearest = nearest_point(wall, x, y);
      if ((nearest.vertex < 0) != faces || nearest.distance2 >= radius * radius) continue;
      if (faces) {
        cover(wall.vertex_a), cover(wall.vertex_b);
      } else {
        if (is_covered(nearest.vertex)) continue;
        cover(nearest.vertex);
      }
      touch(candidates[c], wall, nearest);
    }
  }
}

template <class Visit>
void for_each_grain_near_walls(const std::vector<WallCandidate>& candidates, Visit visit) {
  for (std::size_t from = 0; from < candidates.size();) {
    std::size_t to = from + 1;
    while (to < candidates.size() && candidates[to].grain == candidates[from].grain) ++to;
    visit(static_cast<std::size_t>(candidates[from].grain), from, to);
    from = to;
  }
}

/// A wall is a grain of compliance 0, inverse mass 0 and infinite radius: the law is the pair's.
template <class Law, class Effects>
void wall_forces(const Grains& grains, const Motion& at, std::vector<WallCandidate>& candidates,
                 const std::vector<PlacedWall>& walls, const ContactParameters& parameters, Forces& forces,
                 ContactCensus& census) {
  for_each_grain_near_walls(candidates, [&](std::size_t i, std::size_t from, std::size_t to) {
    const GrainKind kind = grains.kind(i);
    const double stiffness = Law::stiffness(kind.compliance, 0.0);
    const double damping =
        Effects::damping ? Law::damping(parameters.wall.damping_ratio, stiffness, kind.inverse_mass, 0.0) : 0.0;
    for (std::size_t c = from; c < to; ++c) {
      WallCandidate& candidate = candidates[c];
      const NearestPoint nearest = nearest_point(walls[static_cast<std::size_t>(candidate.wall)], at.x[i], at.y[i]);
      if (nearest.vertex >= 0)
        candidate.side = nearest.side;
      else if (nearest.side * candidate.side < 0)
        census.crossed.push_back(static_cast<int>(i));
    }
    for_each_wall_contact(candidates, from, to, walls, at.x[i], at.y[i], kind.radius,
                          [&](const WallCandidate& candidate, const PlacedWall& wall, const NearestPoint& nearest) {
                            const double distance = std::sqrt(nearest.distance2);
                            double nx = 0, ny = 0;
                            if (distance > 0) {
                              nx = nearest.dx / distance, ny = nearest.dy / distance;
                            } else {  // the centre lies on the wall: pushed back to the side it came from
                              // Along the wall, with the side > 0 to the left.
                              const bool arc = wall.radius > 0;
                              const double ex = arc ? at.y[i] - wall.centre_y : wall.bx - wall.ax;
                              const double ey = arc ? wall.centre_x - at.x[i] : wall.by - wall.ay;
                              const double length = std::copysign(std::sqrt(ex * ex + ey * ey), candidate.side);
                              nx = ey / length, ny = -ex / length;
                            }
                            const double overlap = kind.radius - distance;
                            census.max_compression = std::max(census.max_compression, overlap / kind.radius);
                            ++census.contacts;
                            const double wall_vx = wall.vx - wall.spin * (at.y[i] + nearest.dy);
                            const double wall_vy = wall.vy + wall.spin * (at.x[i] + nearest.dx);
                            const double ux = at.vx[i] - wall_vx, uy = at.vy[i] - wall_vy;
                            const double approach = ux * nx + uy * ny;
                            [[maybe_unused]] const double arm = kind.radius - parameters.arm_shortening * overlap;
                            [[maybe_unused]] double sliding = uy * nx - ux * ny;
                            if constexpr (Effects::rotation) sliding += arm * at.omega[i];
                            const auto force = contact_force<Law, Effects::friction, Effects::damping>(
                                overlap, approach, sliding, stiffness, damping, parameters.wall);
                            double px = force.normal * nx, py = force.normal * ny;
                            if constexpr (Effects::friction) px -= force.tangential * ny, py += force.tangential * nx;
                            forces.fx[i] -= px, forces.fy[i] -= py;
                            if constexpr (Effects::rotation) forces.torque[i] -= arm * force.tangential;
                            census.wall_power -= px * wall_vx + py * wall_vy;
                          });
  });
}

template <class Law>
double elastic_energy(const Grains& grains, const Motion& at, const PairList& list,
                      const std::vector<WallCandidate>& candidates, const std::vector<PlacedWall>& walls) {
  double energy = 0;
  for (std::size_t i = 0; i < list.grains(); ++i) {
    const GrainKind a = grains.kind(i);
    for (int k = list.first[i]; k < list.first[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(list.partner[static_cast<std::size_t>(k)]);
      const GrainKind b = grains.kind(j);
      const double dx = at.x[j] - at.x[i], dy = at.y[j] - at.y[i];
      const double overlap = a.radius + b.radius - std::sqrt(dx * dx + dy * dy);
      if (overlap > 0) energy += Law::elastic_energy(Law::stiffness(a.compliance, b.compliance), overlap);
    }
  }
  for_each_grain_near_walls(candidates, [&](std::size_t i, std::size_t from, std::size_t to) {
    const GrainKind kind = grains.kind(i);
    for_each_wall_contact(candidates, from, to, walls, at.x[i], at.y[i], kind.radius,
                          [&](const WallCandidate&, const PlacedWall&, const NearestPoint& nearest) {
                            const double overlap = kind.radius - std::sqrt(nearest.distance2);
                            energy += Law::elastic_energy(Law::stiffness(kind.compliance, 0.0), overlap);
                          });
  });
  return energy;
}

}  // namespace vibrosow
