#include "grains/grains.hpp"

namespace vibrosow {

std::vector<GrainKind> grain_kinds(const Scene& scene, bool rotation) {
  std::vector<GrainKind> kinds;
  for (const SeedLot& lot : scene.lots) {
    const double radius = 0.5 * lot.diameter;
    const double inertia_factor = lot.shape == Shape::disc ? 0.5 : 0.4;
    const double inertia = inertia_factor * lot.mass * radius * radius;
    const double eps = scene.contact.shell_compression * radius;
    kinds.push_back(
        {radius, lot.mass, 1 / lot.mass, rotation ? 1 / inertia : 0.0, eps / (lot.mass * standard_gravity)});
  }
  return kinds;
}

void Grains::add(double px, double py, double pvx, double pvy, int lot_index) {
  x.push_back(px);
  y.push_back(py);
  vx.push_back(pvx);
  vy.push_back(pvy);
  if (rotation) omega.push_back(0);
  lot.push_back(lot_index);
  number.push_back(next_number_++);
  if (!unequal) return;
  const GrainKind& k = kinds[static_cast<std::size_t>(lot_index)];
  radius.push_back(k.radius);
  inverse_mass.push_back(k.inverse_mass);
  inverse_inertia.push_back(k.inverse_inertia);
  compliance.push_back(k.compliance);
  compliance_per_radius.push_back(k.compliance / k.radius);
}

void Grains::remove_flagged(const std::vector<char>& remove) {
  const auto keep = [&remove](auto& array) {
    if (array.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < array.size(); ++i)
      if (!remove[i]) array[kept++] = array[i];
    array.resize(kept);
  };
  keep(x), keep(y), keep(vx), keep(vy), keep(omega), keep(lot), keep(number);
  keep(radius), keep(inverse_mass), keep(inverse_inertia), keep(compliance), keep(compliance_per_radius);
}

}  // namespace vibrosow
