#include "plan/contact_parameters.hpp"

#include "grains/grains.hpp"
#include "laws/restitution.hpp"
#include "scene/surfaces.hpp"

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
          .cohesion = surface.cohesion};
}

std::optional<ElasticMaterial> wall_material(const Contact& contact) {
  if (!contact.wall_youngs_modulus) return std::nullopt;
  return ElasticMaterial{*contact.wall_youngs_modulus, contact.wall_poisson_ratio};
}

}  // namespace

ContactParameters contact_parameters(const Contact& contact, const std::vector<SeedLot>& lots) {
  const LawTraits& law = traits_of(contact.law);
  const std::optional<ElasticMaterial> wall = wall_material(contact);
  ContactParameters parameters;
  parameters.lots = lots.size();
  std::vector<SeedMaterial> seeds;
  for (const SeedLot& lot : lots) seeds.push_back(seed_material(contact, lot));
  const int count = static_cast<int>(lots.size());
  const auto parameters_between = [&](int lot, int other, const RubbingMaterials& materials) {
    return parameters_of(contact, surface_between(contact, lot, other),
                         law.tangential_ratio(materials, contact.tangential_ratio));
  };
  for (int a = 0; a < count; ++a) {
    const SeedMaterial& seed = seeds[static_cast<std::size_t>(a)];
    for (int b = 0; b < count; ++b) {
      const SeedMaterial& other = seeds[static_cast<std::size_t>(b)];
      parameters.pairs.push_back(
          parameters_between(a, b, {seed, ElasticMaterial{other.youngs_modulus, other.poisson_ratio}}));
    }
    parameters.walls.push_back(parameters_between(a, -1, {seed, wall}));
  }
  parameters.wall_compliance = law.wall_compliance(wall);
  parameters.arm_shortening = contact.friction_arm == FrictionArm::contact_point ? 1 : 0;
  return parameters;
}

}  // namespace vibrosow
