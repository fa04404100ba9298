#include "grains/clump_discs.hpp"

#include <algorithm>

#include "portable_math/functions.hpp"

namespace vibrosow {

GrainKind kind_of_disc(const GrainKind& clump, const ClumpDisc& disc, double size, const LawTraits& law) {
  GrainKind own = clump;
  own.radius = disc.radius * size;
  // eps goes with the disc's own radius, under the whole clump's weight
  own.compliance = law.compliance_of_size(clump.compliance, own.radius / clump.radius, 1);
  // |a x n|^2 about each principal axis, on the mean over directions n: (|a|^2 - a_k^2) / 3
  const std::array<double, 3> arm = {disc.x * size, disc.y * size, disc.z * size};
  const double arm2 = arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2];
  own.lever_yield = 0;
  for (std::size_t k = 0; k < 3; ++k)
    own.lever_yield += (arm2 - arm[k] * arm[k]) / 3 * clump.inverse_inertia / clump.moments[k];
  return own;
}

ClumpDiscs::ClumpDiscs(const std::vector<SeedLot>& lots, const std::vector<GrainKind>& kinds, const LawTraits& law,
                       bool rotation)
    : lots_(lots), law_(law), discs_per_id_(1), discs_(kinds, true, rotation) {
  for (const SeedLot& lot : lots) discs_per_id_ = std::max(discs_per_id_, static_cast<std::int64_t>(lot.discs.size()));
}

void ClumpDiscs::rebuild(const Grains& clumps) {
  discs_ = Grains(discs_.kinds, true, discs_.rotation);
  discs_.is_3d = clumps.is_3d;
  own_x_.clear(), own_y_.clear(), own_z_.clear(), first_.clear();
  for (std::size_t i = 0; i < clumps.size(); ++i) {
    const SeedLot& lot = lots_[static_cast<std::size_t>(clumps.lot[i])];
    const GrainKind clump = clumps.kind(i);
    const double size = 2 * clump.radius / lot.diameter;
    std::int64_t id = clumps.id[i] * discs_per_id_;
    first_.push_back(discs_.size());
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
  first_.push_back(discs_.size());
  arm_x_ = own_x_, arm_y_ = own_y_;
  if (!discs_.is_3d) return;
  arms_.resize(discs_.size()), places_.resize(discs_.size()), motions_.resize(discs_.size());
}

void ClumpDiscs::place(const Grains& clumps, Execution& execution) {
  discs_.is_3d ? place_3d(clumps, execution) : place_in_plane(clumps);
}

void ClumpDiscs::place_in_plane(const Grains& clumps) {
  portable_math::SineCosine turn{0, 1};
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(discs_.clump[k]);
    const bool first = k == 0 || discs_.clump[k - 1] != discs_.clump[k];
    if (first) turn = portable_math::sine_cosine(clumps.angle[i]);
    const auto [sine, cosine] = turn;
    arm_x_[k] = cosine * own_x_[k] - sine * own_y_[k];
    arm_y_[k] = sine * own_x_[k] + cosine * own_y_[k];
    const double omega = clumps.rotation ? clumps.omega[i] : 0;
    discs_.x[k] = clumps.x[i] + arm_x_[k], discs_.y[k] = clumps.y[i] + arm_y_[k];
    discs_.vx[k] = clumps.vx[i] - omega * arm_y_[k], discs_.vy[k] = clumps.vy[i] + omega * arm_x_[k];
    if (discs_.rotation) discs_.omega[k] = omega;
  }
}

void ClumpDiscs::place_3d(const Grains& clumps, Execution& execution) {
  const bool turns = clumps.rotation;
  const ClumpMotion motion{.place = {clumps.x.data(), clumps.y.data(), clumps.z.data()},
                           .velocity = {clumps.vx.data(), clumps.vy.data(), clumps.vz.data()},
                           .quaternion = {clumps.q_w.data(), clumps.q_x.data(), clumps.q_y.data(), clumps.q_z.data()},
                           .spin = {turns ? clumps.omega_x.data() : nullptr, turns ? clumps.omega_y.data() : nullptr,
                                    turns ? clumps.omega.data() : nullptr}};
  const ClumpBalls balls{first_.data(), own_x_.data(), own_y_.data(), own_z_.data()};
  const PlacedBalls placed{arms_.data(),    places_.data(),  motions_.data(),
                           discs_.x.data(), discs_.y.data(), discs_.z.data()};
  execution.share(clumps.size(), [&](std::size_t from, std::size_t to) {
    execution.clump_loops().place(from, to, motion, balls, placed);
  });
}

void ClumpDiscs::gather(const Forces& on_discs, Forces& on_clumps) const {
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(discs_.clump[k]);
    const GrainForce& disc = on_discs[k];
    on_clumps[i].fx += disc.fx, on_clumps[i].fy += disc.fy;
    if (discs_.rotation) on_clumps[i].torque += disc.torque + arm_x_[k] * disc.fy - arm_y_[k] * disc.fx;
  }
}

void ClumpDiscs::gather(const Forces3d& on_balls, Forces3d& on_clumps, Execution& execution) const {
  const std::size_t clumps = first_.size() - 1;
  on_clumps.forces.resize(clumps), on_clumps.torques.resize(discs_.rotation ? clumps : 0);
  const auto or_null = [](auto& rows) { return rows.empty() ? nullptr : rows.data(); };
  const ClumpForces forces{on_balls.forces.data(), or_null(on_balls.torques), on_clumps.forces.data(),
                           or_null(on_clumps.torques)};
  execution.share(clumps, [&](std::size_t from, std::size_t to) {
    execution.clump_loops().gather(from, to, first_.data(), arms_.data(), forces);
  });
}

std::vector<char> ClumpDiscs::flags_of_discs(const std::vector<char>& of_clumps) const {
  std::vector<char> flags(discs_.size());
  for (std::size_t k = 0; k < flags.size(); ++k) flags[k] = of_clumps[static_cast<std::size_t>(discs_.clump[k])];
  return flags;
}

}  // namespace vibrosow
