#pragma once

#include <cmath>

#include "vessel/placed_wall.hpp"

namespace vibrosow {

/// The nearest point of a wall to a grain's centre.
struct NearestPoint {
  double dx, dy;     // m, from the centre to the point
  double distance2;  // m2
  bool inside;       // whether it lies inside the wall (a face), not at an end of it
  double side;       // sign tells the side of the wall's line: left of a to b, or outside an arc's circle
};

inline NearestPoint nearest_on_arc(const PlacedWall& wall, double x, double y) {
  const double rx = x - wall.centre_x, ry = y - wall.centre_y;
  const double r = std::sqrt(rx * rx + ry * ry), side = r - wall.radius;
  double px = wall.centre_x + wall.radius * wall.middle_x, py = wall.centre_y + wall.radius * wall.middle_y;
  bool inside = true;
  if (r > 0 && rx * wall.middle_x + ry * wall.middle_y > r * wall.cos_half) {
    px = wall.centre_x + wall.radius * rx / r, py = wall.centre_y + wall.radius * ry / r;
  } else if (r > 0) {
    const double ax = x - wall.ax, ay = y - wall.ay, bx = x - wall.bx, by = y - wall.by;
    const bool at_a = ax * ax + ay * ay <= bx * bx + by * by;
    inside = false;
    px = at_a ? wall.ax : wall.bx, py = at_a ? wall.ay : wall.by;
  }
  const double dx = px - x, dy = py - y;
  return {dx, dy, dx * dx + dy * dy, inside, side};
}

/// Inlined by force: clang leaves a call of it in the loop over wall candidates.
[[gnu::always_inline]] inline NearestPoint nearest_point(const PlacedWall& wall, double x, double y) {
  if (wall.radius > 0) return nearest_on_arc(wall, x, y);
  const double ex = wall.bx - wall.ax, ey = wall.by - wall.ay;
  const double rx = x - wall.ax, ry = y - wall.ay;
  const double length2 = ex * ex + ey * ey;
  const double along = (rx * ex + ry * ey) / length2;
  const double side = ex * ry - ey * rx;
  // On a face straight along the normal, which a level floor then has without any rounding.
  if (along > 0 && along < 1) {
    const double dx = side * ey / length2, dy = -side * ex / length2;
    return {dx, dy, dx * dx + dy * dy, true, side};
  }
  const bool at_a = along <= 0;
  const double dx = (at_a ? wall.ax : wall.bx) - x, dy = (at_a ? wall.ay : wall.by) - y;
  return {dx, dy, dx * dx + dy * dy, false, side};
}

}  // namespace vibrosow
