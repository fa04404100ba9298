#pragma once

#include "plan/packed_bed.hpp"

namespace vibrosow {

/// The fastest ways in which a closely packed bed of equal grains vibrates, its contacts having a slope k and a
/// tangential ratio rho: against each other, omega^2 = (normal + tangential rho) k / m, and all turning alike, omega^2
/// = 2 x rho k / m with x = turning m r^2 / I. In 2D hexagonal, in 3D face-centred cubic; computed over all
/// wave vectors.
struct ClosestPacking {
  double normal, tangential, turning;
};
constexpr ClosestPacking closest_packing(Space space) {
  return space == Space::two_dimensional ? ClosestPacking{6, 3, 6} : ClosestPacking{8, 8, 8};
}

/// The longest step (s) with which velocity Verlet keeps a bed's vibrations stable. A mode of elastic and dashpot
/// forces K and C over mass is stable up to h^2 K / 4 + h C / 2 = 1, K and C being those that the scheme makes of each
/// contact's k and c: over 1 + c h / (2 m_c), m_c the mass that the two have against each other
/// (docs/explanation/theory.md). The fastest mode of `bed` keeps to 9/16 of that, found by power iteration; that of
/// equal seeds in the closest packing, which only what is laid so has, to 9/10.
double longest_stable_step(const StepBasis& basis, const PackedBed& bed);

}  // namespace vibrosow
