#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grains/orientation.hpp"
#include "laws/law.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a grain is made of.
struct GrainKind {
  double radius;           // m; of a clump: of the circle about its centre of mass that just holds it
  double mass;             // kg
  double inverse_mass;     // 1/kg
  double inverse_inertia;  // 1/(kg m2); 0 without rotation; of a clump in 3D: of its smallest principal moment
  double compliance;       // m/N of one shell, eps / (m g); with Hertz' law 1/Pa, (1 - nu^2) / E
  std::array<double, 3> moments{1, 1, 1};  // of a clump in 3D: its principal moments over the smallest
  /// 1/kg, of a clump's disc: how fast a force of 1 N moves it by turning its clump, on the mean over all directions in
  /// which it may be touched.
  double lever_yield = 0;

  bool operator==(const GrainKind&) const = default;
};

/// What each lot's seeds are made of: its own values, or the contact's.
std::vector<SeedMaterial> seed_materials(const Contact& contact, const std::vector<SeedLot>& lots);

/// A seed of each lot's diameter. Shell stiffness c = m g / eps with eps = shell_compression r (paper A).
std::vector<GrainKind> grain_kinds(const std::vector<SeedLot>& lots, const std::vector<SeedMaterial>& materials,
                                   const LawTraits& law);

/// A seed of a lot whose size is `size` times the lot's diameter. Mass grows with size to its `mass_power`; under its
/// own weight the shell yields by the same fraction of the radius.
GrainKind sized_kind(const SeedLot& lot, const LawTraits& law, const GrainKind& kind, double size);

/// State of all grains in the lab frame, structure of arrays. Order is order of insertion and survives removal.
/// Arrays of an absent effect are empty: `omega` without rotation, the property arrays for equal grains.
struct Grains {
  std::vector<double> x, y;                // m
  std::vector<double> vx, vy;              // m/s
  std::vector<double> omega;               // rad/s, anticlockwise
  std::vector<double> z, vz;               // m, m/s: across the plane; of balls in 3D alone
  std::vector<double> omega_x, omega_y;    // rad/s; of balls in 3D alone
  std::vector<double> angle;               // rad, how far a clump is turned from its lot's shape; only in 2D
  std::vector<double> q_w, q_x, q_y, q_z;  // the same of clumps in 3D: unit quaternions from its own axes
  std::vector<int> lot;
  std::vector<std::int64_t> id;  // order of insertion, from 0

  std::vector<GrainKind> kinds;  // by lot
  bool polydisperse = false;     // whether the arrays below are filled
  bool rotation = false;
  bool is_3d = false;
  std::vector<double> radius, mass, inverse_mass, inverse_inertia, compliance, curvature, lever_yield;  // curvature 1/m

  std::int64_t next_id = 0;  // of the next grain that is added
  bool oriented = false;     // whether angles are kept, in 3D quaternions
  std::vector<int> clump{};  // where these are the discs of clumps: which clump each belongs to; else empty

  Grains(std::vector<GrainKind> lot_kinds, bool with_polydisperse, bool with_rotation, bool with_angles = false)
      : kinds(std::move(lot_kinds)), polydisperse(with_polydisperse), rotation(with_rotation), oriented(with_angles) {}

  std::size_t size() const { return x.size(); }
  GrainKind kind(std::size_t i) const {
    if (!polydisperse) return kinds.front();
    return {radius[i],          mass[i],       inverse_mass[i],
            inverse_inertia[i], compliance[i], kinds[static_cast<std::size_t>(lot[i])].moments,
            lever_yield[i]};
  }
  /// m and m/s, of the lab; z is 0 in 2D.
  Eigen::Vector3d place(std::size_t i) const { return {x[i], y[i], is_3d ? z[i] : 0.0}; }
  Eigen::Vector3d velocity(std::size_t i) const { return {vx[i], vy[i], is_3d ? vz[i] : 0.0}; }
  Orientation orientation(std::size_t i) const { return {q_w[i], q_x[i], q_y[i], q_z[i]}; }
  std::array<std::vector<double>*, 4> quaternions() { return {&q_w, &q_x, &q_y, &q_z}; }
  void set_orientation(std::size_t i, const Orientation& q) { q_w[i] = q.w, q_x[i] = q.x, q_y[i] = q.y, q_z[i] = q.z; }

  /// Appends a grain of `lot_index`, of the lot's own kind, and gives it the next id.
  void add(double px, double py, double pvx, double pvy, int lot_index);
  /// The same with properties of its own, which only count where `polydisperse` is set; a clump turned by `turned`
  /// (rad).
  void add(double px, double py, double pvx, double pvy, int lot_index, const GrainKind& own, double turned = 0);

  /// The same at a place (m) and with a velocity (m/s) of the lab, whose z counts in 3D alone.
  void add(const Eigen::Vector3d& at, const Eigen::Vector3d& velocity, int lot_index, const GrainKind& own,
           const Turn& turned = {});

  /// Keeps the grains whose flag is 0, in order. `remove` has one flag a grain.
  void remove_flagged(const std::vector<char>& remove);
};

}  // namespace vibrosow
