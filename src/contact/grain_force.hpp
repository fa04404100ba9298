#pragma once

#include <vector>

namespace vibrosow {

/// Contact force on one grain; four numbers, so that vector instructions add them at once.
struct alignas(32) GrainForce {
  double fx = 0, fy = 0;  // N
  double torque = 0;      // N m; 0 without rotation
  double spare = 0;       // means nothing
};

/// By grain.
using Forces = std::vector<GrainForce>;

/// Force of a contact on a grain that another range of grains owns.
struct ForeignForce {
  int grain;
  double fx, fy, torque;  // N, N m
};

}  // namespace vibrosow
