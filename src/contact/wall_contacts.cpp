#include "contact/wall_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

/// Where the centre lies on the wall it is pushed back to the side it came from.
void set_normal_on_wall(const WallCandidate& candidate, const PlacedWall& wall, double x, double y,
                        WallContacts& contacts, std::size_t k) {
  // Along the wall, with the side > 0 to the left.
  const bool arc = wall.radius > 0;
  const double ex = arc ? y - wall.centre_y : wall.bx - wall.ax;
  const double ey = arc ? wall.centre_x - x : wall.by - wall.ay;
  const double length = std::copysign(std::sqrt(ex * ex + ey * ey), candidate.side);
  contacts.normal_x[k] = ey / length, contacts.normal_y[k] = -ex / length;
}

void add(const WallCandidate& candidate, std::size_t c, const NearestPoint& nearest, const PlacedWall& wall, double x,
         double y, WallContacts& contacts) {
  const std::size_t k = static_cast<std::size_t>(contacts.count++);
  contacts.candidate[k] = static_cast<int>(c), contacts.grain[k] = candidate.grain;
  contacts.dx[k] = nearest.dx, contacts.dy[k] = nearest.dy, contacts.distance2[k] = nearest.distance2;
  const auto at_point = [&](const PlacedWall::Moving& moving, double& vx, double& vy) {
    vx = moving.vx - moving.spin * (y + nearest.dy), vy = moving.vy + moving.spin * (x + nearest.dx);
  };
  at_point(wall.now, contacts.wall_vx[k], contacts.wall_vy[k]);
  at_point(wall.on_mean, contacts.mean_wall_vx[k], contacts.mean_wall_vy[k]);
  contacts.wall_spin[k] = wall.on_mean.spin;
  if (nearest.distance2 == 0) set_normal_on_wall(candidate, wall, x, y, contacts, k);
}

void make_room(std::size_t most, WallContacts& contacts) {
  if (contacts.grain.size() >= most) return;
  for (std::vector<int>* array : {&contacts.candidate, &contacts.grain}) array->resize(most);
  for (std::vector<double>* array :
       {&contacts.dx, &contacts.dy, &contacts.distance2, &contacts.normal_x, &contacts.normal_y, &contacts.wall_vx,
        &contacts.wall_vy, &contacts.wall_spin, &contacts.mean_wall_vx, &contacts.mean_wall_vy, &contacts.fx,
        &contacts.fy, &contacts.torque})
    array->resize(most);
}

}  // namespace

void WallContactFinder::find(const Grains& grains, std::span<const WallCandidate> candidates, std::size_t first,
                             const std::vector<PlacedWall>& walls, WallContacts& contacts) {
  const std::size_t count = candidates.size();
  make_room(count, contacts);
  contacts.count = 0;
  nearest_.resize(count), near_.resize(count + 1);
  touches_.begin(first, count);
  const auto wall_of = [&](std::size_t c) -> const PlacedWall& {
    return walls[static_cast<std::size_t>(candidates[c].wall)];
  };
  const auto grain_of = [&](std::size_t c) { return static_cast<std::size_t>(candidates[c].grain); };
  const auto radius_of = [&](std::size_t i) {
    return grains.polydisperse ? grains.radius[i] : grains.kinds.front().radius;
  };
  std::size_t near = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t i = grain_of(c);
    const double radius = radius_of(i);
    nearest_[c] = nearest_point(wall_of(c), grains.x[i], grains.y[i]);
    near_[near] = c;
    near += nearest_[c].distance2 < radius * radius ? 1 : 0;
  }
  const auto touch_of = [&](std::size_t c) {
    const NearestPoint& nearest = nearest_[c];
    return WallTouches::Touch{c, {nearest.dx, nearest.dy, 0}, std::sqrt(nearest.distance2), nearest.inside};
  };
  const auto from_wall = [&](std::size_t c, const Eigen::Vector3d& apart) {
    const std::size_t i = grain_of(c);
    return nearest_point(wall_of(c), grains.x[i] + apart.x(), grains.y[i] + apart.y()).distance2;
  };
  const auto push = [&](std::size_t c) {
    const std::size_t i = grain_of(c);
    add(candidates[c], first + c, nearest_[c], wall_of(c), grains.x[i], grains.y[i], contacts);
  };
  touches_.push_each(candidates, {near_.data(), near}, touch_of, radius_of, from_wall, push);
}

void WallContactFinder::watch_crossings(std::span<WallCandidate> candidates, std::vector<int>& crossed) const {
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!nearest_[c].inside)
      candidates[c].side = nearest_[c].side;
    else if (nearest_[c].side * candidates[c].side < 0)
      crossed.push_back(candidates[c].grain);
  }
}

void add_wall_forces(const WallContacts& contacts, bool rotation, Forces& forces) {
  const std::size_t count = static_cast<std::size_t>(contacts.count);
  for (std::size_t k = 0; k < count;) {
    const std::size_t i = static_cast<std::size_t>(contacts.grain[k]);
    double sum_x = 0, sum_y = 0, sum_torque = 0;
    for (; k < count && contacts.grain[k] == static_cast<int>(i); ++k) {
      sum_x -= contacts.fx[k], sum_y -= contacts.fy[k];
      if (rotation) sum_torque += contacts.torque[k];
    }
    forces[i].fx += sum_x, forces[i].fy += sum_y;
    if (rotation) forces[i].torque += sum_torque;
  }
}

void add_wall_power(const WallContacts& contacts, double& power) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(contacts.count); ++k)
    power -= contacts.fx[k] * contacts.wall_vx[k] + contacts.fy[k] * contacts.wall_vy[k];
}

}  // namespace vibrosow
