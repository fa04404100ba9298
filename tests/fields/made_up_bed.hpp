#pragma once

#include <Eigen/Core>
#include <numbers>

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

inline Vessel made_up_tray(double length) {
  Vessel tray;
  tray.name = "tray";
  tray.length = length;
  tray.height = 0.1;
  return tray;
}

/// One more grain of 2 mm radius and 30 mg, numbered in order.
inline void put(Snapshot& s, double x, double y, double vx = 0, double vy = 0, int lot = 0, double radius = 2e-3,
                double mass = 30e-6) {
  s.id.push_back(static_cast<std::int64_t>(s.size()));
  s.x.push_back(x), s.y.push_back(y);
  s.vx.push_back(vx), s.vy.push_back(vy);
  s.omega.push_back(0);
  s.lot.push_back(lot);
  s.radius.push_back(radius), s.mass.push_back(mass);
  s.area.push_back(std::numbers::pi * radius * radius);
  s.start_x.push_back(x), s.start_y.push_back(y);
}

/// One more ball in 3D.
inline void put_ball(Snapshot& s, const Eigen::Vector3d& at, const Eigen::Vector3d& velocity = {0, 0, 0}, int lot = 0,
                     double radius = 2e-3, double mass = 30e-6) {
  put(s, at.x(), at.y(), velocity.x(), velocity.y(), lot, radius, mass);
  s.area.clear();
  s.z.push_back(at.z()), s.vz.push_back(velocity.z());
  s.omega_x.push_back(0), s.omega_y.push_back(0);
  s.start_z.push_back(at.z());
  s.volume.push_back(4 * std::numbers::pi / 3 * radius * radius * radius);
}

/// `side` x `side` x `side` balls of 2 mm radius in a body-centred packing of 5 mm cells, the first at (3 mm, 5 mm, 4
/// mm), each where `place` and with the velocity that `velocity` makes of its place there.
template <typename Place, typename Velocity>
Snapshot body_centred_bed(int side, Place place, Velocity velocity) {
  Snapshot s;
  for (int layer = 0; layer < side; ++layer)
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const double aside = 2.5e-3 * (layer % 2);
        const Eigen::Vector3d at(3e-3 + 5e-3 * column + aside, 5e-3 + 2.5e-3 * layer, 4e-3 + 5e-3 * row + aside);
        put_ball(s, place(at), velocity(at));
      }
  return s;
}

/// `side` x `side` grains of 2 mm radius in a hexagonal packing, the first at (3 mm, 5 mm), each where `place` and with
/// the velocity that `velocity` makes of its place there.
template <typename Place, typename Velocity>
Snapshot hexagonal_bed(int side, Place place, Velocity velocity) {
  Snapshot s;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const Eigen::Vector2d at(3e-3 + 4e-3 * (column + 0.5 * (row % 2)), 5e-3 + 4e-3 * 0.8660254037844386 * row);
      const Eigen::Vector2d p = place(at), v = velocity(at);
      put(s, p.x(), p.y(), v.x(), v.y());
    }
  return s;
}

}  // namespace vibrosow
