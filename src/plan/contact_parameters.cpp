#include "plan/contact_parameters.hpp"

#include <algorithm>

#include "contact/restitution.hpp"
#include "scene/surfaces.hpp"

namespace vibrosow {
namespace {

/// What one surface gives to the stiffness of a contact; a rigid wall yields nothing.
struct Material {
  double normal = 0;   // 1/Pa, (1 - nu^2) / E
  double tangent = 0;  // 1/Pa, (2 - nu) / G
};

Material material(double youngs_modulus, double poisson_ratio) {
  const double shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio));
  return {(1 - poisson_ratio * poisson_ratio) / youngs_modulus, (2 - poisson_ratio) / shear_modulus};
}

Material seed_material(const Contact& contact, const SeedLot& lot) {
  return material(lot.youngs_modulus.value_or(contact.youngs_modulus),
                  lot.poisson_ratio.value_or(contact.poisson_ratio));
}

Material wall_material(const Contact& contact) {
  return contact.wall_youngs_modulus ? material(*contact.wall_youngs_modulus, contact.wall_poisson_ratio) : Material{};
}

/// k_t over the secant k sqrt(d) of Hertz' law: 8 G* sqrt(R* d) = 6 (G*/E*) k sqrt(d).
double mindlin_ratio(const Material& a, const Material& b) {
  return 6 * (a.normal + b.normal) / (a.tangent + b.tangent);
}

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

}  // namespace

ContactParameters contact_parameters(const Scene& scene) {
  const Contact& contact = scene.contact;
  const bool hertz = contact.law != Law::elastic_shell;
  const auto ratio = [&](const Material& a, const Material& b) {
    return hertz ? contact.tangential_ratio.value_or(1) * mindlin_ratio(a, b)
                 : contact.tangential_ratio.value_or(2.0 / 7);
  };
  ContactParameters parameters;
  parameters.lots = scene.lots.size();
  const int lots = static_cast<int>(parameters.lots);
  const Material wall = wall_material(contact);
  for (int a = 0; a < lots; ++a) {
    const Material seed = seed_material(contact, scene.lots[static_cast<std::size_t>(a)]);
    for (int b = 0; b < lots; ++b)
      parameters.pairs.push_back(
          parameters_of(contact, surface_between(contact, a, b),
                        ratio(seed, seed_material(contact, scene.lots[static_cast<std::size_t>(b)]))));
    parameters.walls.push_back(parameters_of(contact, surface_between(contact, a, -1), ratio(seed, wall)));
  }
  parameters.wall_compliance = hertz ? wall.normal : 0;
  parameters.arm_shortening = contact.friction_arm == FrictionArm::contact_point ? 1 : 0;
  return parameters;
}

}  // namespace vibrosow
