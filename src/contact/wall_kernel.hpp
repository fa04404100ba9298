#pragma once

#include <array>
#include <cmath>

#include "contact/kernels.hpp"
#include "contact/pair_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

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
  const double length2 = ex * ex + ey * ey;
  const double along = (rx * ex + ry * ey) / length2;
  const double side = ex * ry - ey * rx;
  // On a face straight along the normal, which a level floor then has without any rounding.
  if (along > 0 && along < 1) {
    const double dx = side * ey / length2, dy = -side * ex / length2;
    return {dx, dy, dx * dx + dy * dy, -1, side};
  }
  const bool at_a = along <= 0;
  const double dx = (at_a ? wall.ax : wall.bx) - x, dy = (at_a ? wall.ay : wall.by) - y;
  return {dx, dy, dx * dx + dy * dy, at_a ? wall.vertex_a : wall.vertex_b, side};
}

/// The nearest points of all candidates [from, to) of one grain.
class NearestPoints {
 public:
  static constexpr std::size_t most = 32;  // kept; a grain near more walls than that looks again

  NearestPoints(const std::vector<WallCandidate>& candidates, std::size_t from, std::size_t to,
                const std::vector<PlacedWall>& walls, double x, double y)
      : candidates_(candidates), walls_(walls), x_(x), y_(y), from_(from) {
    for (std::size_t c = from; c < to && c - from < most; ++c) kept_[c - from] = of(c);
  }
  NearestPoint operator[](std::size_t candidate) const {
    return candidate - from_ < most ? kept_[candidate - from_] : of(candidate);
  }

 private:
  NearestPoint of(std::size_t candidate) const {
    return nearest_point(walls_[static_cast<std::size_t>(candidates_[candidate].wall)], x_, y_);
  }
  const std::vector<WallCandidate>& candidates_;
  const std::vector<PlacedWall>& walls_;
  double x_, y_;
  std::size_t from_;
  std::array<NearestPoint, most> kept_;
};

/// Calls `touch(candidate, nearest)` for each contact of a grain, which owns candidates [from, to): faces first, then
/// each end point once and only where no touched face ends in it.
template <class Touch>
void for_each_wall_contact(const std::vector<WallCandidate>& candidates, std::size_t from, std::size_t to,
                           const std::vector<PlacedWall>& walls, const NearestPoints& points, double radius,
                           Touch touch) {
  bool any = false;
  for (std::size_t c = from; c < to; ++c) any |= points[c].distance2 < radius * radius;
  if (!any) return;
  constexpr std::size_t most = 32;  // end points met at once: many more than a plane corner can have
  std::array<int, most> covered;
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
      const NearestPoint nearest = points[c];
      if ((nearest.vertex < 0) != faces || nearest.distance2 >= radius * radius) continue;
      if (faces) {
        const PlacedWall& wall = walls[static_cast<std::size_t>(candidates[c].wall)];
        cover(wall.vertex_a), cover(wall.vertex_b);
      } else {
        if (is_covered(nearest.vertex)) continue;
        cover(nearest.vertex);
      }
      touch(c, nearest);
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

/// A grain and the walls, seen as a grain of infinite radius and mass: the law is the pair's.
template <class Law, class Effects>
PairConstants wall_constants(const GrainKind& kind, const ContactParameters& parameters,
                             const SurfaceParameters& surface) {
  return pair_constants<Law, Effects>(
      {kind.radius, kind.compliance, kind.inverse_mass, kind.inverse_inertia, 1 / kind.radius},
      {0, parameters.wall_compliance, 0, 0, 0}, surface);
}

/// Follows the side of each candidate and notes grains that changed it beside the wall.
inline void watch_crossings(std::vector<WallCandidate>& candidates, std::size_t from, std::size_t to,
                            const NearestPoints& points, ContactCensus& census) {
  for (std::size_t c = from; c < to; ++c) {
    const NearestPoint nearest = points[c];
    if (nearest.vertex >= 0)
      candidates[c].side = nearest.side;
    else if (nearest.side * candidates[c].side < 0)
      census.crossed.push_back(candidates[c].grain);
  }
}

template <class Law, class Effects>
void wall_forces(const Grains& grains, const Motion& at, std::vector<WallCandidate>& candidates,
                 const std::vector<PlacedWall>& walls, const ContactParameters& parameters,
                 const HistoryAdvance& advance, ContactHistory& history, Forces& forces, ContactCensus& census) {
  double sum_x = 0, sum_y = 0, sum_torque = 0;  // of one grain: two walls add up alike in either order
  const auto contact = [&](std::size_t i, const GrainKind& kind, const PairConstants& pair,
                           const SurfaceParameters& surface, std::size_t c, const NearestPoint& nearest) {
    const WallCandidate& candidate = candidates[c];
    const PlacedWall& wall = walls[static_cast<std::size_t>(candidate.wall)];
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
    Touch touch{kind.radius - distance, 0, 0, 0};
    census.max_compression = std::max(census.max_compression, touch.overlap * pair.compression_per_overlap);
    ++census.contacts;
    const double wall_vx = wall.vx - wall.spin * (at.y[i] + nearest.dy);
    const double wall_vy = wall.vy + wall.spin * (at.x[i] + nearest.dx);
    const double ux = at.vx[i] - wall_vx, uy = at.vy[i] - wall_vy;
    touch.approach = ux * nx + uy * ny;
    [[maybe_unused]] const double arm = kind.radius - parameters.arm_shortening * touch.overlap * pair.share_i;
    touch.sliding = uy * nx - ux * ny;
    if constexpr (Effects::rotation) touch.sliding += arm * at.omega[i];
    if constexpr (Effects::rolls) touch.turning = at.omega[i] - wall.spin;
    ContactMemory memory = recall<Effects>(history, c);
    const ContactForce force = contact_force<Law, Effects>(touch, pair, surface, advance, memory);
    if (advance.commit > 0) store<Effects>(memory, history, c);
    double px = force.normal * nx, py = force.normal * ny;
    if constexpr (Effects::friction) px -= force.tangential * ny, py += force.tangential * nx;
    sum_x -= px, sum_y -= py;
    if constexpr (Effects::rotation) sum_torque += force.rolling - arm * force.tangential;
    census.wall_power -= px * wall_vx + py * wall_vy;
  };
  const PairConstants equal = wall_constants<Law, Effects>(grains.kinds.front(), parameters, parameters.walls.front());
  const auto constants_of = [&](const GrainKind& kind, const SurfaceParameters& surface) {
    return Effects::unequal ? wall_constants<Law, Effects>(kind, parameters, surface) : equal;
  };
  for_each_grain_near_walls(candidates, [&](std::size_t i, std::size_t from, std::size_t to) {
    const NearestPoints points(candidates, from, to, walls, at.x[i], at.y[i]);
    watch_crossings(candidates, from, to, points, census);
    const GrainKind kind = grains.kind(i);
    const SurfaceParameters& surface = parameters.wall(grains.lot[i]);
    sum_x = sum_y = sum_torque = 0;
    std::uint64_t touched = 0;  // bit by candidate; a grain meets far fewer than 64 walls
    for_each_wall_contact(candidates, from, to, walls, points, kind.radius,
                          [&](std::size_t c, const NearestPoint& nearest) {
                            touched |= std::uint64_t{1} << ((c - from) & 63);
                            contact(i, kind, constants_of(kind, surface), surface, c, nearest);
                          });
    forces.fx[i] += sum_x, forces.fy[i] += sum_y;
    if constexpr (Effects::rotation) forces.torque[i] += sum_torque;
    for (std::size_t c = from; c < to; ++c)
      if (advance.commit > 0 && !(touched >> ((c - from) & 63) & 1)) store<Effects>({}, history, c);
  });
}

template <class Law, class Effects>
double wall_energy(const Grains& grains, const Motion& at, const std::vector<WallCandidate>& candidates,
                   const std::vector<PlacedWall>& walls, const ContactParameters& parameters,
                   const ContactHistory& history) {
  double energy = 0;
  for_each_grain_near_walls(candidates, [&](std::size_t i, std::size_t from, std::size_t to) {
    const GrainKind kind = grains.kind(i);
    const SurfaceParameters& surface = parameters.wall(grains.lot[i]);
    const PairConstants pair = wall_constants<Law, Effects>(kind, parameters, surface);
    const NearestPoints points(candidates, from, to, walls, at.x[i], at.y[i]);
    for_each_wall_contact(candidates, from, to, walls, points, kind.radius,
                          [&](std::size_t c, const NearestPoint& nearest) {
                            const double overlap = kind.radius - std::sqrt(nearest.distance2);
                            energy += contact_energy<Law, Effects>(overlap, pair, surface, recall<Effects>(history, c));
                          });
  });
  return energy;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
