#include "grains/grains.hpp"

namespace vibrosow {

std::vector<SeedMaterial> seed_materials(const Contact& contact, const std::vector<SeedLot>& lots) {
  std::vector<SeedMaterial> materials;
  for (const SeedLot& lot : lots)
    materials.push_back({.radius = 0.5 * lot.diameter,
                         .weight = lot.mass * standard_gravity,
                         .shell_compression = lot.shell_compression.value_or(contact.shell_compression),
                         .youngs_modulus = lot.youngs_modulus.value_or(contact.youngs_modulus),
                         .poisson_ratio = lot.poisson_ratio.value_or(contact.poisson_ratio)});
  return materials;
}

std::vector<GrainKind> grain_kinds(const std::vector<SeedLot>& lots, const std::vector<SeedMaterial>& materials,
                                   const LawTraits& law) {
  std::vector<GrainKind> kinds;
  for (std::size_t l = 0; l < lots.size(); ++l) {
    const SeedLot& lot = lots[l];
    const double radius = 0.5 * lot.diameter;
    const double gyration2 = lot.shape == Shape::clump  ? lot.gyration2
                             : lot.shape == Shape::disc ? 0.5 * radius * radius
                                                        : 0.4 * radius * radius;
    const double inertia = lot.mass * gyration2;
    kinds.push_back({radius, lot.mass, 1 / lot.mass, 1 / inertia, law.compliance(materials[l])});
  }
  return kinds;
}

GrainKind sized_kind(const SeedLot& lot, const LawTraits& law, const GrainKind& kind, double size) {
  if (size == 1) return kind;
  const double growth = lot.shape == Shape::ball ? size * size * size : size * size;
  const double mass = kind.mass * growth;
  return {kind.radius * size, mass, 1 / mass, kind.inverse_inertia / (growth * size * size),
          law.compliance_of_size(kind.compliance, size, growth)};
}

void Grains::add(double px, double py, double pvx, double pvy, int lot_index) {
  add(px, py, pvx, pvy, lot_index, kinds[static_cast<std::size_t>(lot_index)]);
}

void Grains::add(double px, double py, double pvx, double pvy, int lot_index, const GrainKind& own, double turned) {
  x.push_back(px);
  y.push_back(py);
  vx.push_back(pvx);
  vy.push_back(pvy);
  if (rotation) omega.push_back(0);
  if (oriented) angle.push_back(turned);
  lot.push_back(lot_index);
  id.push_back(next_id++);
  if (!polydisperse) return;
  radius.push_back(own.radius);
  mass.push_back(own.mass);
  inverse_mass.push_back(own.inverse_mass);
  inverse_inertia.push_back(own.inverse_inertia);
  compliance.push_back(own.compliance);
  curvature.push_back(1 / own.radius);
}

void Grains::add(const Eigen::Vector3d& at, const Eigen::Vector3d& velocity, int lot_index, const GrainKind& own,
                 double turned) {
  add(at.x(), at.y(), velocity.x(), velocity.y(), lot_index, own, turned);
  if (!in_space) return;
  z.push_back(at.z());
  vz.push_back(velocity.z());
  if (rotation) omega_x.push_back(0), omega_y.push_back(0);
}

void Grains::remove_flagged(const std::vector<char>& remove) {
  const auto keep = [&remove](auto& array) {
    if (array.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < array.size(); ++i)
      if (!remove[i]) array[kept++] = array[i];
    array.resize(kept);
  };
  keep(z), keep(vz), keep(omega_x), keep(omega_y);
  keep(x), keep(y), keep(vx), keep(vy), keep(omega), keep(angle), keep(lot), keep(id);
  keep(radius), keep(mass), keep(inverse_mass), keep(inverse_inertia), keep(compliance), keep(curvature);
}

}  // namespace vibrosow
