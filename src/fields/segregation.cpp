#include "fields/segregation.hpp"

#include <algorithm>
#include <cmath>

#include "fields/tray_frame.hpp"

namespace vibrosow {
namespace {

struct WeightedMean {
  double sum = 0, weight = 0;
  void add(double value, double by) { sum += by * value, weight += by; }
  double mean() const { return sum / weight; }
};

}  // namespace

std::vector<LotInLayer> lot_profile(const Snapshot& own, const Vessel& tray, int lots, double thickness) {
  const std::vector<std::size_t> inside = grains_in_tray(own, tray);
  const auto layer_of = [&](std::size_t i) { return static_cast<std::size_t>(own.y[i] / thickness); };
  std::size_t layers = 0;
  for (const std::size_t i : inside) layers = std::max(layers, layer_of(i) + 1);
  const auto count = static_cast<std::size_t>(lots);
  std::vector<LotInLayer> profile(layers * count);
  for (std::size_t k = 0; k < profile.size(); ++k) {
    profile[k].height = (static_cast<double>(k / count) + 0.5) * thickness;
    profile[k].lot = static_cast<int>(k % count);
  }
  std::vector<double> mass(layers, 0.0);
  for (const std::size_t i : inside) {
    LotInLayer& row = profile[layer_of(i) * count + static_cast<std::size_t>(own.lot[i])];
    ++row.grains;
    row.mass += own.mass[i];
    mass[layer_of(i)] += own.mass[i];
  }
  for (std::size_t k = 0; k < profile.size(); ++k) profile[k].mass_fraction = profile[k].mass / mass[k / count];
  return profile;
}

std::optional<double> segregation_index(const Snapshot& own, const Vessel& tray, int lot) {
  WeightedMean of_lot, of_others, of_all;
  for (const std::size_t i : grains_in_tray(own, tray)) {
    (own.lot[i] == lot ? of_lot : of_others).add(own.y[i], own.extent()[i]);
    of_all.add(own.y[i], own.extent()[i]);
  }
  if (of_lot.weight == 0 || of_others.weight == 0) return std::nullopt;
  return (of_lot.mean() - of_others.mean()) / of_all.mean();
}

}  // namespace vibrosow
