#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "grains/turning_clump.hpp"
#include "simulation/force_field.hpp"

namespace vibrosow {

/// One coordinate of all grains as it moves. Spins of balls in 3D and components of quaternions have no place; the
/// array of an absent effect is empty.
struct Coordinate {
  std::vector<double>* place;  // null: there is none
  std::vector<double>*speed, *rate;
  HigherDerivatives* higher;  // gear5
};

/// Those that there are.
struct Moving {
  std::vector<Coordinate> along, about;  // the axes; clumps in 3D turn in a way of their own, but for gear5
  std::vector<Coordinate> axes;          // both, in that order
  std::vector<Coordinate> quaternions;   // of clumps in 3D, under gear5
  Moving(Grains& grains, IntegratorState& kept);
};

/// What an integrator moves, with what, and where it keeps things within a step.
struct Integration {
  const Model& model;
  SimulationState& state;
  ForceField& field;
  Execution& execution;
  Grains& grains;         // of the state
  IntegratorState& kept;  // of the state
  double dt;              // s
  double drag;            // kg/s
  double fastest;         // m/s; a step that ends with a faster grain is noted

  std::atomic<bool> too_fast = false;  // whether a grain was faster at the end of the last step
  Moving moving{grains, kept};

  // The state at the beginning of a step (rk2_midpoint), of the coordinates along the axes, then about them; the last
  // line of clumps in 3D alone.
  std::vector<std::vector<double>> places{}, speeds{};
  std::vector<Orientation> orientation{};

  std::array<std::vector<double>, 3> moments = moments_by_lot(grains);  // of clumps
};

/// One step of a scheme. Velocity Verlet works out forces from the places at the end of a step and the velocities in
/// its middle; what depends on velocities takes its own part in their change until the end into account (ContactStep),
/// and is of second order for drag and for one contact at a time, of first order where contacts share a grain. RK2 is
/// paper A's midpoint scheme, with the walls at the middle of the step too; gear5 is the fifth-order
/// predictor-corrector in Nordsieck form for forces that depend on velocity (alpha_0 = 3/16; Gear 1971, Allen &
/// Tildesley 1987), one evaluation a step. Clumps in 3D turn as clump_rotation.hpp has it.
using StepFunction = void (*)(Integration&);
StepFunction step_function(Integrator integrator);

/// Computes the acceleration at the present time and state; gear5 also the higher derivatives, to full order, from the
/// accelerations along three fourth-order steps ahead, after which the state is put back.
void start_integration(Integration& s);

/// Grains were put in at the end of the arrays, or taken out (one flag each), since the last step.
void add_to_integration(Integration& s);
void remove_from_integration(Integration& s, const std::vector<char>& removed);

/// Force evaluations a step takes: 1 or 2.
int evaluations_per_step(Integrator integrator);

}  // namespace vibrosow
