#include "plan/contact_parameters.hpp"

#include "laws/restitution.hpp"

namespace vibrosow {
namespace {

SurfaceParameters parameters_of(const Contact& contact, const Surface& surface, double tangential_ratio) {
  return {.friction = surface.friction,
          .inverse_slip_speed = 1 / contact.slip_speed,
          .damping_ratio = linear_damping_ratio(surface.restitution),
          .damping_rate = contact.damping_rate,
          .tangential_ratio = tangential_ratio,
          .tangential_damping = contact.tangential_damping,
          .rolling_friction = surface.rolling_friction,
          .rolling_damping = contact.rolling_damping,
          .twisting_friction = surface.twisting_friction,
          .cohesion = surface.cohesion};
}

std::optional<ElasticMaterial> wall_material(const Contact& contact) {
  if (!contact.wall_youngs_modulus) return std::nullopt;
  return ElasticMaterial{*contact.wall_youngs_modulus, contact.wall_poisson_ratio};
}

}  // namespace

ContactParameters contact_parameters(const Contact& contact, const Surfaces& surfaces,
                                     const std::vector<SeedMaterial>& materials, const LawTraits& law) {
  const std::optional<ElasticMaterial> wall = wall_material(contact);
  const std::size_t lots = materials.size();
  ContactParameters parameters;
  parameters.lots = lots;
  const auto between = [&](const Surface& surface, const RubbingMaterials& rubbing) {
    return parameters_of(contact, surface, law.tangential_ratio(rubbing, contact.tangential_ratio));
  };
  for (std::size_t a = 0; a < lots; ++a) {
    for (std::size_t b = 0; b < lots; ++b) {
      const ElasticMaterial other{materials[b].youngs_modulus, materials[b].poisson_ratio};
      parameters.pairs.push_back(between(surfaces.pairs[a * lots + b], {materials[a], other}));
    }
    parameters.walls.push_back(between(surfaces.walls[a], {materials[a], wall}));
  }
  parameters.wall_compliance = law.wall_compliance(wall);
  parameters.arm_shortening = contact.friction_arm == FrictionArm::contact_point ? 1 : 0;
  return parameters;
}

}  // namespace vibrosow
