#pragma once

#include <Eigen/Core>

#include "grains/grains.hpp"
#include "loops/turning_clump.hpp"

namespace vibrosow {

/// How a clump lies, with its inertia. It can turn (GrainKind::inverse_inertia > 0).
TurningClump turning_clump(const Grains& grains, std::size_t i);

/// Principal moments over the smallest about each axis, by lot.
std::array<std::vector<double>, 3> moments_by_lot(const Grains& grains);

/// rad/s, of a ball or clump in 3D.
Vector3 spin_of(const Grains& grains, std::size_t i);
void set_spin(Grains& grains, std::size_t i, const Vector3& spin);

/// Whether the grains are clumps in 3D, which turn by their quaternions.
inline bool turn_as_clumps(const Grains& grains) {
  return grains.is_3d && grains.oriented && grains.rotation;
}

}  // namespace vibrosow
