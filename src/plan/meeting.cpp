#include "plan/meeting.hpp"

#include <algorithm>

namespace vibrosow {
namespace {

Meeting meeting(const LawTraits& law, const GrainKind& a, double compliance, double curvature, double inverse_mass) {
  const double fraction = a.compliance / (a.compliance + compliance);
  return {law.stiffness(a.compliance, compliance, 1 / a.radius, curvature), a.inverse_mass + inverse_mass,
          fraction / a.radius};
}

}  // namespace

Meeting on_wall(const StepBasis& basis, const GrainKind& a) {
  return meeting(basis.law, a, basis.contacts.wall_compliance, 0, 0);
}

Meeting with_grain(const StepBasis& basis, const GrainKind& a, const GrainKind& b) {
  return meeting(basis.law, a, b.compliance, 1 / b.radius, b.inverse_mass);
}

double impact_speed(const StepBasis& basis) {
  return basis.scene.numerics.impact_speed.value_or(basis.loads.grain_speed);
}

double steepest_slope(const StepBasis& basis, const Meeting& meeting, double mass) {
  const double weight = basis.loads.layers * basis.loads.weight_factor * mass * standard_gravity;
  const double overlap =
      std::max(basis.law.impact_overlap(meeting.stiffness, meeting.inverse_mass, impact_speed(basis)),
               basis.law.static_overlap(meeting.stiffness, weight));
  return basis.law.slope(meeting.stiffness, overlap);
}

}  // namespace vibrosow
