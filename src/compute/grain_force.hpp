#pragma once

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

}  // namespace vibrosow
