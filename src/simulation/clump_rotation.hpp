#pragma once

#include <cstddef>

#include "simulation/integrator.hpp"

namespace vibrosow {

// Rotation of clumps in 3D, of the grains [from, to), in each scheme's terms. What turns a clump is its torque, not
// an angular acceleration: the angular momentum of a clump that none acts on stays what it is, to rounding.

/// Velocity Verlet: how clumps lie at the end of a step, and the spins there by the angular momentum in its middle.
/// `alpha` of the state holds the torques (N m) at its beginning.
void predict_clump_rotation(Integration& s, std::size_t from, std::size_t to);
/// Spins at the end of a step, by the torques of the last evaluation, which are kept.
void correct_clump_rotation(Integration& s, std::size_t from, std::size_t to);

/// What the scheme needs of the last evaluation: the torques; or, for gear5, the rates alpha = I^-1 (T - omega x I
/// omega) of the spins and omega q / 2 of the quaternions.
void keep_clump_rates(Integration& s, std::size_t from, std::size_t to);

/// Midpoint RK2: from how clumps lay and turned at the beginning of the step, `dt` on with the present spins and the
/// torques kept. First with the spins of the beginning, by half a step, then with those of the middle.
void advance_clump_rotation(Integration& s, double dt, std::size_t from, std::size_t to);

/// Gear: quaternions have drifted from unit length by a step's error.
void bring_to_unit_length(Grains& grains, std::size_t from, std::size_t to);

}  // namespace vibrosow
