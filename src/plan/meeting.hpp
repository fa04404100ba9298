#pragma once

#include "plan/step_plan.hpp"

namespace vibrosow {

/// Two bodies that meet: a grain and another, or a wall (curvature and inverse mass 0).
struct Meeting {
  double stiffness;  // of the law
  double inverse_mass, relative_per_overlap;
};
Meeting on_wall(const StepBasis& basis, const GrainKind& a);
Meeting with_grain(const StepBasis& basis, const GrainKind& a, const GrainKind& b);

/// Speed of impact at which a law whose contacts last differently is looked at, m/s.
double impact_speed(const StepBasis& basis);

/// The steepest slope (N/m) of a contact: at the larger of the overlaps of impact and of the weight of the layers above
/// of seeds of `mass` (kg).
double steepest_slope(const StepBasis& basis, const Meeting& meeting, double mass);

}  // namespace vibrosow
