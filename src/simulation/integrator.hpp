#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/force_field.hpp"

namespace vibrosow {

/// What an integrator moves, and what it keeps from step to step.
struct Integration {
  Grains& grains;
  ForceField& field;
  double dt;                // s
  Eigen::Vector2d gravity;  // m/s2
  double drag;              // kg/s

  double time = 0;  // s
  std::int64_t step = 0;
  ContactCensus census{};
  double wall_work = 0;                               // J
  double gross_wall_work = 0;                         // J, sizes summed
  std::vector<double> ax{}, ay{}, alpha{};            // acceleration at the beginning of the step
  double wall_power = 0;                              // W, then
  std::vector<double> x{}, y{}, vx{}, vy{}, omega{};  // the old state, for schemes that need it
};

/// One step of a scheme. Velocity Verlet uses predicted velocities v + a dt in the forces, which keeps second order
/// with damping and drag; RK2 is paper A's midpoint scheme, with the walls at the middle of the step too.
using StepFunction = void (*)(Integration&);
StepFunction step_function(Integrator integrator, bool rotation, bool drag, bool unequal);

/// Computes the acceleration at the present time and state: at the start, and after grains were put in or taken out.
void start_integration(Integration& s);

/// Force evaluations a step takes: 1 or 2.
int evaluations_per_step(Integrator integrator);

}  // namespace vibrosow
