#pragma once

#include <vector>

#include "loops/grain_force.hpp"

namespace vibrosow {

/// By grain, in 3D: forces, N, and torques about the centres, N m, which without rotation are empty.
struct Forces3d {
  std::vector<GrainVector> forces, torques;
};

}  // namespace vibrosow
