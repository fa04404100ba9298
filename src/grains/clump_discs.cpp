#include "grains/clump_discs.hpp"

#include <algorithm>

#include "elementary/functions.hpp"
#include "grains/turning_clump.hpp"
#include "scene/cross_product.hpp"

namespace vibrosow {

GrainKind kind_of_disc(const GrainKind& clump, const ClumpDisc& disc, double size, const LawTraits& law) {
  GrainKind own = clump;
  own.radius = disc.radius * size;
  // eps goes with the disc's own radius, under the whole clump's weight
  own.compliance = law.compliance_of_size(clump.compliance, own.radius / clump.radius, 1);
  return own;
}

ClumpDiscs::ClumpDiscs(const std::vector<SeedLot>& lots, const std::vector<GrainKind>& kinds, const LawTraits& law,
                       bool rotation)
    : lots_(lots), law_(law), discs_per_id_(1), discs_(kinds, true, rotation) {
  for (const SeedLot& lot : lots) discs_per_id_ = std::max(discs_per_id_, static_cast<std::int64_t>(lot.discs.size()));
}

void ClumpDiscs::rebuild(const Grains& clumps) {
  discs_ = Grains(discs_.kinds, true, discs_.rotation);
  discs_.in_space = clumps.in_space;
  clumps_ = clumps.size();
  own_x_.clear(), own_y_.clear(), own_z_.clear();
  for (std::size_t i = 0; i < clumps.size(); ++i) {
    const SeedLot& lot = lots_[static_cast<std::size_t>(clumps.lot[i])];
    const GrainKind clump = clumps.kind(i);
    const double size = 2 * clump.radius / lot.diameter;
    std::int64_t id = clumps.id[i] * discs_per_id_;
    const auto add = [&](const ClumpDisc& disc) {
      const GrainKind kind = kind_of_disc(clump, disc, size, law_);
      discs_.add(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), clumps.lot[i], kind);
      discs_.id.back() = id++;
      discs_.clump.push_back(static_cast<int>(i));
      own_x_.push_back(disc.x * size), own_y_.push_back(disc.y * size), own_z_.push_back(disc.z * size);
    };
    if (lot.discs.empty()) add({0, 0, 0.5 * lot.diameter});
    for (const ClumpDisc& disc : lot.discs) add(disc);
  }
  arm_x_ = own_x_, arm_y_ = own_y_, arm_z_ = own_z_;
}

void ClumpDiscs::place(const Grains& clumps) {
  discs_.in_space ? place_in_space(clumps) : place_in_plane(clumps);
}

void ClumpDiscs::place_in_plane(const Grains& clumps) {
  elementary::SineCosine turn{0, 1};
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(discs_.clump[k]);
    const bool first = k == 0 || discs_.clump[k - 1] != discs_.clump[k];
    if (first) turn = elementary::sine_cosine(clumps.angle[i]);
    const auto [sine, cosine] = turn;
    arm_x_[k] = cosine * own_x_[k] - sine * own_y_[k];
    arm_y_[k] = sine * own_x_[k] + cosine * own_y_[k];
    const double omega = clumps.rotation ? clumps.omega[i] : 0;
    discs_.x[k] = clumps.x[i] + arm_x_[k], discs_.y[k] = clumps.y[i] + arm_y_[k];
    discs_.vx[k] = clumps.vx[i] - omega * arm_y_[k], discs_.vy[k] = clumps.vy[i] + omega * arm_x_[k];
    if (discs_.rotation) discs_.omega[k] = omega;
  }
}

void ClumpDiscs::place_in_space(const Grains& clumps) {
  Eigen::Matrix3d axes;
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(discs_.clump[k]);
    if (k == 0 || discs_.clump[k - 1] != discs_.clump[k]) {
      axes = rotation_matrix(clumps.orientation(i));
      if (clumps.rotation) spin = spin_of(clumps, i);
    }
    const Eigen::Vector3d arm = axes * Eigen::Vector3d(own_x_[k], own_y_[k], own_z_[k]), turning = cross(spin, arm);
    arm_x_[k] = arm.x(), arm_y_[k] = arm.y(), arm_z_[k] = arm.z();
    discs_.x[k] = clumps.x[i] + arm.x(), discs_.vx[k] = clumps.vx[i] + turning.x();
    discs_.y[k] = clumps.y[i] + arm.y(), discs_.vy[k] = clumps.vy[i] + turning.y();
    discs_.z[k] = clumps.z[i] + arm.z(), discs_.vz[k] = clumps.vz[i] + turning.z();
    if (discs_.rotation) set_spin(discs_, k, spin);
  }
}

void ClumpDiscs::gather(const Forces& on_discs, Forces& on_clumps) const {
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(discs_.clump[k]);
    const GrainForce& disc = on_discs[k];
    on_clumps[i].fx += disc.fx, on_clumps[i].fy += disc.fy;
    if (discs_.rotation) on_clumps[i].torque += disc.torque + arm_x_[k] * disc.fy - arm_y_[k] * disc.fx;
  }
}

void ClumpDiscs::gather(const SpaceForces& on_balls, SpaceForces& on_clumps) const {
  on_clumps.forces.assign(clumps_, {}), on_clumps.torques.assign(discs_.rotation ? clumps_ : 0, {});
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(discs_.clump[k]);
    const GrainVector& f = on_balls.forces[k];
    GrainVector& force = on_clumps.forces[i];
    force.x += f.x, force.y += f.y, force.z += f.z;
    if (!discs_.rotation) continue;
    const Eigen::Vector3d turning = cross({arm_x_[k], arm_y_[k], arm_z_[k]}, {f.x, f.y, f.z});
    GrainVector& torque = on_clumps.torques[i];
    torque.x += turning.x(), torque.y += turning.y(), torque.z += turning.z();
    if (on_balls.torques.empty()) continue;
    const GrainVector& own = on_balls.torques[k];
    torque.x += own.x, torque.y += own.y, torque.z += own.z;
  }
}

std::vector<char> ClumpDiscs::flags_of_discs(const std::vector<char>& of_clumps) const {
  std::vector<char> flags(discs_.size());
  for (std::size_t k = 0; k < flags.size(); ++k) flags[k] = of_clumps[static_cast<std::size_t>(discs_.clump[k])];
  return flags;
}

}  // namespace vibrosow
