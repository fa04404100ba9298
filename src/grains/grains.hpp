#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What is the same for every seed of a lot.
struct GrainKind {
  double radius;           // m
  double mass;             // kg
  double inverse_mass;     // 1/kg
  double inverse_inertia;  // 1/(kg m2); 0 without rotation
  double compliance;       // m/N of one shell, eps / (m g)
};

/// Properties of each lot. Shell stiffness c = m g / eps with eps = shell_compression r (paper A).
std::vector<GrainKind> grain_kinds(const Scene& scene, bool rotation);

/// State of all grains in the lab frame, structure of arrays. Order is order of insertion and survives removal.
/// Arrays of an absent effect are empty: `omega` without rotation, the property arrays for equal grains.
struct Grains {
  std::vector<double> x, y;    // m
  std::vector<double> vx, vy;  // m/s
  std::vector<double> omega;   // rad/s, anticlockwise
  std::vector<int> lot;
  std::vector<std::int64_t> number;  // order of insertion, from 0

  std::vector<GrainKind> kinds;  // by lot
  bool unequal = false;          // whether the arrays below are filled
  bool rotation = false;
  std::vector<double> radius, inverse_mass, inverse_inertia, compliance, compliance_per_radius;

  Grains(std::vector<GrainKind> lot_kinds, bool with_unequal, bool with_rotation)
      : kinds(std::move(lot_kinds)), unequal(with_unequal), rotation(with_rotation) {}

  std::size_t size() const { return x.size(); }
  const GrainKind& kind(std::size_t i) const { return kinds[static_cast<std::size_t>(lot[i])]; }

  /// Appends a grain of `lot_index` and gives it the next number.
  void add(double px, double py, double pvx, double pvy, int lot_index);

  /// Keeps the grains whose flag is 0, in order. `remove` has one flag a grain.
  void remove_flagged(const std::vector<char>& remove);

 private:
  std::int64_t next_number_ = 0;
};

}  // namespace vibrosow
