#include "grains/turning_clump.hpp"

namespace vibrosow {

TurningClump turning_clump(const Grains& grains, std::size_t i) {
  const GrainKind kind = grains.kind(i);
  const double per = kind.inverse_inertia;
  return {grains.orientation(i), {kind.moments[0] / per, kind.moments[1] / per, kind.moments[2] / per}};
}

std::array<std::vector<double>, 3> moments_by_lot(const Grains& grains) {
  std::array<std::vector<double>, 3> moments;
  for (const GrainKind& kind : grains.kinds)
    for (std::size_t axis = 0; axis < 3; ++axis) moments[axis].push_back(kind.moments[axis]);
  return moments;
}

Vector3 spin_of(const Grains& grains, std::size_t i) {
  return {grains.omega_x[i], grains.omega_y[i], grains.omega[i]};
}

void set_spin(Grains& grains, std::size_t i, const Vector3& spin) {
  grains.omega_x[i] = spin.x, grains.omega_y[i] = spin.y, grains.omega[i] = spin.z;
}

}  // namespace vibrosow
