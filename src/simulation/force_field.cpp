#include "simulation/force_field.hpp"

#include <algorithm>
#include <cmath>

#include "plan/contact_parameters.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

ForceField::ForceField(const Scene& scene, const EffectSet& effects, NeighbourMargins margins, Execution& execution)
    : scene_(scene),
      execution_(execution),
      walls_(vessels_of(scene)),
      neighbours_(walls_.vessels(), largest_diameter(scene.lots), margins,
                  {effects.tangential_spring, effects.rolling == Rolling::spring}, execution),
      parameters_(contact_parameters(scene)),
      kernels_(kernels_for(scene.contact.law, effects)),
      pair_kernel_(kernels_.vectors[static_cast<std::size_t>(execution.instructions())].pair),
      wall_kernel_(kernels_.vectors[static_cast<std::size_t>(execution.instructions())].wall),
      range_results_(static_cast<std::size_t>(execution.threads())) {
  if (effects.clumps) clumps_.emplace(scene_, effects.rotation);
}

const Grains& ForceField::place_discs(const Grains& grains) {
  if (!clumps_) return grains;
  if (!clumps_are_current_) clumps_->rebuild(grains);
  clumps_are_current_ = true;
  clumps_->place(grains);
  return clumps_->discs();
}

Motion ForceField::motion_of(const Grains& discs) const {
  return {discs.x.data(), discs.y.data(), discs.vx.data(), discs.vy.data(), discs.omega.data(), discs.x.data()};
}

Motion ForceField::across_boundary(const Grains& discs) {
  shifted_x_ = discs.x;
  for (double& x : shifted_x_) x += neighbours_.period();
  Motion at = motion_of(discs);
  at.row_x = shifted_x_.data();
  return at;
}

/// Each thread takes the rows of a range of grains, whose forces it begins with zero. What they do to grains of earlier
/// ranges is added afterwards, range by range: a grain's own row first, then the later rows in order, as one thread
/// would.
void ForceField::set_pair_forces(const Grains& discs, const Motion& at, const HistoryAdvance& advance, Forces& forces,
                                 ContactStatistics& statistics) {
  const PairList& pairs = neighbours_.pairs();
  ContactHistory& history = neighbours_.pair_history();
  const GrainSurfaces surfaces = surfaces_of(discs);
  const std::size_t ranges = range_results_.size();
  const int grains = static_cast<int>(discs.size());
  forces.resize(discs.size());
  const auto first_grain = [&](std::size_t range) {
    if (range == 0 || range == ranges) return range == 0 ? 0 : grains;
    return pairs.size() == 0 ? grains : pairs.grain[pairs.size() * range / ranges];
  };
  const auto first_entry = [&](std::size_t range) {
    if (range == ranges) return static_cast<int>(pairs.size());
    return static_cast<int>(std::ranges::lower_bound(pairs.grain, first_grain(range)) - pairs.grain.begin());
  };
  execution_.for_each_range([&](int k) {
    const std::size_t range = static_cast<std::size_t>(k);
    RangeResult& result = range_results_[range];
    result.foreign.clear();
    result.statistics = {};
    add_pair_forces(pair_kernel_, surfaces, at, pairs, {first_entry(range), first_entry(range + 1)}, parameters_,
                    advance, history, {first_grain(range), first_grain(range + 1)}, forces, result.foreign,
                    result.statistics);
  });
  for (const RangeResult& result : range_results_) {
    statistics.contacts += result.statistics.contacts;
    statistics.max_compression = std::max(statistics.max_compression, result.statistics.max_compression);
    for (const ForeignForce& force : result.foreign) {
      GrainForce& sum = forces[static_cast<std::size_t>(force.grain)];
      sum.fx += force.fx, sum.fy += force.fy, sum.torque += force.torque;
    }
  }
}

void ForceField::run_kernels(const Grains& discs, const HistoryAdvance& advance, Forces& forces,
                             ContactStatistics& statistics) {
  const Motion at = motion_of(discs);
  set_pair_forces(discs, at, advance, forces, statistics);
  // Few, and their partners come before and after: one thread does them.
  if (neighbours_.period() > 0) {
    const PairList& boundary = neighbours_.boundary_pairs();
    add_pair_forces(pair_kernel_, surfaces_of(discs), across_boundary(discs), boundary,
                    {0, static_cast<int>(boundary.size())}, parameters_, advance, neighbours_.boundary_history(),
                    {0, 0}, forces, range_results_.front().foreign, statistics);
  }
  execution_.profile().lap(Phase::pairs);
  wall_finder_.find(discs, neighbours_.near_walls(), walls_.placed(), wall_contacts_);
  wall_finder_.watch_crossings(neighbours_.near_walls(), statistics.crossed);
  if (advance.commit > 0) wall_finder_.forget_parted(neighbours_.wall_history());
  add_wall_forces(discs, at, advance, forces, statistics);
  execution_.profile().lap(Phase::walls);
}

/// Of the contacts found last.
void ForceField::add_wall_forces(const Grains& discs, const Motion& at, const HistoryAdvance& advance, Forces& forces,
                                 ContactStatistics& statistics) {
  const double compression =
      wall_kernel_(surfaces_of(discs), at, parameters_, advance, neighbours_.wall_history(), wall_contacts_);
  statistics.max_compression = std::max(statistics.max_compression, compression);
  vibrosow::add_wall_forces(wall_contacts_, kernels_.effects.rotation, forces, statistics);
}

void ForceField::evaluate(const Grains& grains, double time, const HistoryAdvance& advance,
                          ContactStatistics& statistics) {
  walls_.place(time);
  const Grains& discs = place_discs(grains);
  neighbours_.update(discs, walls_);
  execution_.profile().lap(Phase::neighbours);
  statistics.wall_power = 0;
  if (!clumps_) return run_kernels(grains, advance, forces_, statistics);
  const std::size_t crossed_before = statistics.crossed.size();
  run_kernels(discs, advance, disc_forces_, statistics);
  forces_.assign(grains.size(), {});
  clumps_->gather(disc_forces_, forces_);
  for (std::size_t k = crossed_before; k < statistics.crossed.size(); ++k)
    statistics.crossed[k] = discs.clump[static_cast<std::size_t>(statistics.crossed[k])];
}

double ForceField::elastic_energy(const Grains& grains) {
  const Grains& discs = place_discs(grains);
  const Motion at = motion_of(discs);
  double energy =
      kernels_.pair_energy(surfaces_of(discs), at, neighbours_.pairs(), parameters_, neighbours_.pair_history());
  if (neighbours_.period() > 0)
    energy += kernels_.pair_energy(surfaces_of(discs), across_boundary(discs), neighbours_.boundary_pairs(),
                                   parameters_, neighbours_.boundary_history());
  wall_finder_.find(discs, neighbours_.near_walls(), walls_.placed(), wall_contacts_);
  return energy + kernels_.wall_energy(surfaces_of(discs), wall_contacts_, parameters_, neighbours_.wall_history());
}

Forces ForceField::wall_forces(const Grains& grains) {
  const Grains& discs = place_discs(grains);
  ContactStatistics statistics;
  Forces on_discs(discs.size());
  wall_finder_.find(discs, neighbours_.near_walls(), walls_.placed(), wall_contacts_);
  add_wall_forces(discs, motion_of(discs), {}, on_discs, statistics);
  if (!clumps_) return on_discs;
  Forces forces(grains.size());
  clumps_->gather(on_discs, forces);
  return forces;
}

std::vector<char> ForceField::touching(const Grains& grains) const {
  std::vector<char> touches(grains.size(), 0);
  const Grains& discs = clumps_ ? clumps_->discs() : grains;
  const auto grain_of = [&](std::size_t k) { return clumps_ ? static_cast<std::size_t>(discs.clump[k]) : k; };
  const auto look = [&](const PairList& pairs, double shift) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::size_t i = static_cast<std::size_t>(pairs.grain[k]), j = static_cast<std::size_t>(pairs.partner[k]);
      const double reach = discs.kind(i).radius + discs.kind(j).radius;
      const double dx = discs.x[j] - (discs.x[i] + shift), dy = discs.y[j] - discs.y[i];
      if (dx * dx + dy * dy < reach * reach) touches[grain_of(i)] = touches[grain_of(j)] = 1;
    }
  };
  look(neighbours_.pairs(), 0);
  look(neighbours_.boundary_pairs(), neighbours_.period());
  return touches;
}

void ForceField::grains_added() {
  clumps_are_current_ = false;
  neighbours_.forget();
}

void ForceField::remove_flagged(const std::vector<char>& removed) {
  clumps_are_current_ = false;
  neighbours_.remove_flagged(clumps_ ? clumps_->flags_of_discs(removed) : removed);
}

void ForceField::remove_wall(std::size_t wall) {
  walls_.remove(wall);
  neighbours_.remove_wall(static_cast<int>(wall));
}

}  // namespace vibrosow
