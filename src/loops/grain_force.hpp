#pragma once

#include <array>
#include <vector>

namespace vibrosow {

/// Contact force on one grain; four numbers, so that vector instructions add them at once.
struct alignas(32) GrainForce {
  double fx, fy;  // N
  double torque;  // N m; 0 without rotation
  double spare;   // means nothing
};

/// By grain.
using Forces = std::vector<GrainForce>;

/// Force of a contact on a grain that another range of grains owns.
struct ForeignForce {
  int grain;
  double fx, fy, torque;  // N, N m
};

/// Place, velocity, spin, force or torque of one ball in 3D, m, m/s, rad/s, N or N m; four numbers as above.
struct alignas(32) GrainVector {
  double x, y, z;
  double spare;
};

/// Of one ball, side by side.
struct alignas(64) BallMotion {
  GrainVector velocity, spin;
};

/// As ForeignForce, in 3D.
struct ForeignForce3d {
  int grain;
  std::array<double, 3> force, torque;  // N, N m
};

}  // namespace vibrosow
