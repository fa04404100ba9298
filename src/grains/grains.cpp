#include "grains/grains.hpp"

#include <algorithm>

#include "portable_math/functions.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

/// Moment of inertia over mass, m2; of a clump in 3D the smallest.
double gyration2_of(const SeedLot& lot) {
  const double radius = 0.5 * lot.diameter;
  if (is_solid_clump(lot)) return std::min({lot.gyration2_x, lot.gyration2_y, lot.gyration2});
  if (lot.shape == Shape::clump) return lot.gyration2;
  return lot.shape == Shape::disc ? 0.5 * radius * radius : 0.4 * radius * radius;
}

std::array<double, 3> moments_of(const SeedLot& lot) {
  if (!is_solid_clump(lot)) return {1, 1, 1};
  const double least = gyration2_of(lot);
  return {lot.gyration2_x / least, lot.gyration2_y / least, lot.gyration2 / least};
}

}  // namespace

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
    const double inertia = lot.mass * gyration2_of(lot);
    kinds.push_back(
        {0.5 * lot.diameter, lot.mass, 1 / lot.mass, 1 / inertia, law.compliance(materials[l]), moments_of(lot)});
  }
  return kinds;
}

GrainKind sized_kind(const SeedLot& lot, const LawTraits& law, const GrainKind& kind, double size) {
  if (size == 1) return kind;
  const double growth = portable_math::pow(size, mass_power(lot));
  const double mass = kind.mass * growth;
  return {kind.radius * size,
          mass,
          1 / mass,
          kind.inverse_inertia / (growth * size * size),
          law.compliance_of_size(kind.compliance, size, growth),
          kind.moments,
          kind.lever_yield / growth};
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
  if (oriented && !is_3d) angle.push_back(turned);
  lot.push_back(lot_index);
  id.push_back(next_id++);
  if (!polydisperse) return;
  radius.push_back(own.radius);
  mass.push_back(own.mass);
  inverse_mass.push_back(own.inverse_mass);
  inverse_inertia.push_back(own.inverse_inertia);
  compliance.push_back(own.compliance);
  curvature.push_back(1 / own.radius);
  lever_yield.push_back(own.lever_yield);
}

void Grains::add(const Eigen::Vector3d& at, const Eigen::Vector3d& velocity, int lot_index, const GrainKind& own,
                 const Turn& turned) {
  add(at.x(), at.y(), velocity.x(), velocity.y(), lot_index, own, turned.angle);
  if (!is_3d) return;
  z.push_back(at.z());
  vz.push_back(velocity.z());
  if (rotation) omega_x.push_back(0), omega_y.push_back(0);
  if (!oriented) return;
  const Orientation& q = turned.orientation;
  q_w.push_back(q.w), q_x.push_back(q.x), q_y.push_back(q.y), q_z.push_back(q.z);
}

void Grains::remove_flagged(const std::vector<char>& remove) {
  const auto keep = [&remove](auto& array) {
    if (array.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < array.size(); ++i)
      if (!remove[i]) array[kept++] = array[i];
    array.resize(kept);
  };
  keep(z), keep(vz), keep(omega_x), keep(omega_y), keep(q_w), keep(q_x), keep(q_y), keep(q_z);
  keep(x), keep(y), keep(vx), keep(vy), keep(omega), keep(angle), keep(lot), keep(id);
  keep(radius), keep(mass), keep(inverse_mass), keep(inverse_inertia), keep(compliance), keep(curvature);
  keep(lever_yield);
}

}  // namespace vibrosow
