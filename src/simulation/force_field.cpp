#include "simulation/force_field.hpp"

#include <algorithm>
#include <cmath>

#include "scene/seed_lot.hpp"

namespace vibrosow {

ForceField::ForceField(const Model& model, SimulationState& state, NeighbourMargins margins, Execution& execution)
    : model_(model),
      state_(state),
      execution_(execution),
      walls_(model.vessels, model.scene.space),
      neighbours_(model.vessels, largest_disc_diameter(model.scene.lots), margins,
                  {model.effects.tangential_spring, model.effects.rolling == Rolling::spring,
                   model.scene.space == Space::three_dimensional},
                  execution),
      of_ranges_(static_cast<std::size_t>(execution.threads())) {
  const std::size_t instructions = static_cast<std::size_t>(execution.instructions());
  part_2d_ = {model.kernels->vectors[instructions], model.kernels->energy, {}, {}, {}};
  part_3d_ = {model.kernels->vectors_3d[instructions], model.kernels->energy_3d, {}, {}, {}};
  part_2d_.ranges.resize(of_ranges_.size()), part_3d_.ranges.resize(of_ranges_.size());
  for (auto& range : part_3d_.ranges) range.finder = WallFinder3d(execution.instructions());
  if (model.effects.clumps) clumps_.emplace(model.scene.lots, model.kinds, *model.law, model.effects.rotation);
  for (std::size_t v = 0; v < model.vessels.size(); ++v)
    walls_.set_motion(v, state.vessels.motion[v], state.vessels.shift[v]);
  for (std::size_t wall = 0; wall < state.vessels.removed.size(); ++wall)
    if (state.vessels.removed[wall]) remove_wall(wall);
  walls_.place(state.vessels.placed_at);
  if (state.started) neighbours_.update(place_discs(), walls_, state_.vessels.placed_at, state_.contacts);
}

const Grains& ForceField::place_discs() {
  const Grains& grains = state_.grains;
  if (!clumps_) return grains;
  if (!clumps_are_current_) clumps_->rebuild(grains);
  clumps_are_current_ = true;
  clumps_->place(grains, execution_);
  return clumps_->discs();
}

ForceField::PairShare ForceField::pair_share(std::size_t range, std::size_t grains) const {
  const PairList& pairs = state_.contacts.pairs;
  const std::size_t ranges = of_ranges_.size();
  const auto first_grain = [&](std::size_t k) {
    if (k == 0) return 0;
    return k == ranges || pairs.size() == 0 ? static_cast<int>(grains) : pairs.grain[pairs.size() * k / ranges];
  };
  const auto first_entry = [&](std::size_t k) {
    if (k == ranges) return static_cast<int>(pairs.size());
    return static_cast<int>(std::ranges::lower_bound(pairs.grain, first_grain(k)) - pairs.grain.begin());
  };
  return {{first_grain(range), first_grain(range + 1)}, {first_entry(range), first_entry(range + 1)}};
}

ForceField::WallRange ForceField::wall_range(std::size_t range) {
  std::vector<WallCandidate>& all = state_.contacts.walls;
  const auto first_of = [&](std::size_t k) {
    std::size_t first = all.size() * k / of_ranges_.size();
    while (first > 0 && first < all.size() && all[first].grain == all[first - 1].grain) ++first;
    return first;
  };
  const std::size_t from = first_of(range);
  return {from, {all.data() + from, first_of(range + 1) - from}};
}

/// Range by range: what is a sum of fractions is added up contact by contact elsewhere, as one thread would.
void ForceField::add_up_ranges(ContactStatistics& statistics) const {
  for (const ContactStatistics& of : of_ranges_) {
    statistics.contacts += of.contacts;
    statistics.slip_raised += of.slip_raised;
    statistics.max_relative_overlap = std::max(statistics.max_relative_overlap, of.max_relative_overlap);
    statistics.crossed.insert(statistics.crossed.end(), of.crossed.begin(), of.crossed.end());
  }
}

/// Each thread takes the rows of a range of grains, whose forces it begins with zero. What they do to grains of earlier
/// ranges is added afterwards, range by range: a grain's own row first, then the later rows in order, as one thread
/// would.
template <class In>
void ForceField::set_pair_forces(Part<In>& part, const Grains& discs, const typename In::Moving& at,
                                 const ContactStep& step, typename In::Sums& sums, ContactStatistics& statistics) {
  const GrainSurfaces surfaces = surfaces_of(discs);
  resize(sums, discs.size(), model_.kernels->effects.rotation);
  execution_.for_each_range([&](int k) {
    const std::size_t range = static_cast<std::size_t>(k);
    const PairShare share = pair_share(range, discs.size());
    part.ranges[range].foreign.clear();
    of_ranges_[range] = {};
    add_pair_forces(part.kernels.pair, surfaces, at, state_.contacts.pairs, share.entries, model_.contacts, step,
                    state_.contacts.pair_histories, share.grains, sums, part.ranges[range].foreign, of_ranges_[range]);
  });
  add_up_ranges(statistics);
  for (const auto& range : part.ranges) add_foreign(range.foreign, sums);
}

/// A grain's walls are all in one range, so its forces are added up alike for any number of ranges.
template <class In>
void ForceField::add_walls(Part<In>& part, const Grains& discs, const typename In::Moving& at, const ContactStep& step,
                           typename In::Sums& sums, ContactStatistics& statistics) {
  ContactHistories& histories = state_.contacts.wall_histories;
  const GrainSurfaces surfaces = surfaces_of(discs);
  execution_.for_each_range([&](int k) {
    const std::size_t range = static_cast<std::size_t>(k);
    const auto [first, candidates] = wall_range(range);
    auto& [foreign, finder, contacts] = part.ranges[range];
    ContactStatistics& own = of_ranges_[range] = {};
    finder.find(discs, candidates, first, In::walls_of(walls_), contacts);
    finder.watch_crossings(candidates, own.crossed);
    if (step.commit != 0) finder.touches().renew(histories);
    add_metrics(part.kernels.wall(surfaces, at, model_.contacts, step, histories, contacts), own);
    if (step.commit != 0) finder.touches().share(histories);
    add_wall_forces(contacts, model_.kernels->effects.rotation, sums);
    own.contacts = contacts.count;
  });
  add_up_ranges(statistics);
  for (const auto& range : part.ranges) add_wall_power(range.contacts, statistics.wall_power);
}

template <class In>
void ForceField::run_kernels(Part<In>& part, const Grains& discs, const ContactStep& step, typename In::Sums& sums,
                             ContactStatistics& statistics) {
  const typename In::Moving at = motion_of(part, discs);
  set_pair_forces(part, discs, at, step, sums, statistics);
  // Few, and their partners come before and after: one thread does them.
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k) {
    BoundaryContacts& boundary = state_.contacts.boundaries[k];
    add_pair_forces(part.kernels.pair, surfaces_of(discs), across(at, discs, neighbours_.images()[k]), boundary.pairs,
                    {0, static_cast<int>(boundary.pairs.size())}, model_.contacts, step, boundary.histories, {0, 0},
                    sums, part.ranges.front().foreign, statistics);
  }
  execution_.profile().lap(Phase::pairs);
  add_walls(part, discs, at, step, sums, statistics);
  execution_.profile().lap(Phase::walls);
}

/// All of them in one range.
template <class In>
typename In::WallContacts& ForceField::find_walls(Part<In>& part, const Grains& discs) {
  auto& only = part.ranges.front();
  only.finder.find(discs, state_.contacts.walls, 0, In::walls_of(walls_), only.contacts);
  return only.contacts;
}

/// With the forces in them; nothing moves on by it.
template <class In>
typename In::WallContacts& ForceField::press_walls(Part<In>& part, const Grains& discs) {
  typename In::WallContacts& touching = find_walls(part, discs);
  part.kernels.wall(surfaces_of(discs), motion_of(part, discs), model_.contacts, {}, state_.contacts.wall_histories,
                    touching);
  return touching;
}

template WallContacts& ForceField::press_walls(Part<Discs2d>&, const Grains&);
template WallContacts3d& ForceField::press_walls(Part<Balls3d>&, const Grains&);

void ForceField::gather(Part<Discs2d>& part) {
  part.on_grains.assign(state_.grains.size(), {});
  clumps_->gather(part.on_discs, part.on_grains);
}
void ForceField::gather(Part<Balls3d>& part) {
  clumps_->gather(part.on_discs, part.on_grains, execution_);
}

void ForceField::evaluate(double time, const ContactStep& step, ContactStatistics& statistics) {
  walls_.place(time, step.lag);
  state_.vessels.placed_at = time;
  const Grains& discs = place_discs();
  neighbours_.update(discs, walls_, time, state_.contacts);
  execution_.profile().lap(Phase::neighbours);
  statistics.wall_power = 0;
  const std::size_t crossed_before = statistics.crossed.size();
  with_part([&](auto& part) {
    run_kernels(part, discs, step, clumps_ ? part.on_discs : part.on_grains, statistics);
    if (clumps_) gather(part);
  });
  if (!clumps_) return;
  for (std::size_t k = crossed_before; k < statistics.crossed.size(); ++k)
    statistics.crossed[k] = discs.clump[static_cast<std::size_t>(statistics.crossed[k])];
}

/// Gear's scheme stores displacements half a step ahead of the places: they are taken back for the moment.
double ForceField::elastic_energy() {
  const bool ahead = model_.scene.numerics.integrator == Integrator::gear5;
  if (!ahead || !state_.contacts.pair_histories.kinds.any()) return energy_of_springs();
  const ContactState kept = state_.contacts;
  const ContactStep back{.trial = -0.5 * model_.step.dt, .commit = -0.5 * model_.step.dt};
  ContactStatistics aside;
  const Grains& discs = place_discs();
  with_part([&]<class In>(Part<In>& part) {
    typename In::Sums sums;
    run_kernels(part, discs, back, sums, aside);
  });
  const double energy = energy_of_springs();
  state_.contacts = kept;
  return energy;
}

double ForceField::energy_of_springs() {
  const Grains& discs = place_discs();
  return with_part([&](auto& part) { return energy_of_springs(part, discs); });
}

template <class In>
double ForceField::energy_of_springs(Part<In>& part, const Grains& discs) {
  const GrainSurfaces surfaces = surfaces_of(discs);
  const typename In::Moving at = motion_of(part, discs);
  double energy =
      part.energies.pair(surfaces, at, state_.contacts.pairs, model_.contacts, state_.contacts.pair_histories);
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k) {
    const BoundaryContacts& boundary = state_.contacts.boundaries[k];
    energy += part.energies.pair(surfaces, across(at, discs, neighbours_.images()[k]), boundary.pairs, model_.contacts,
                                 boundary.histories);
  }
  return energy +
         part.energies.wall(surfaces, find_walls(part, discs), model_.contacts, state_.contacts.wall_histories);
}

Forces ForceField::wall_forces() {
  see_walls_as_they_are();
  const Grains& discs = place_discs();
  Forces on_discs(discs.size());
  add_wall_forces(press_walls(part_2d_, discs), model_.kernels->effects.rotation, on_discs);
  if (!clumps_) return on_discs;
  Forces forces(state_.grains.size());
  clumps_->gather(on_discs, forces);
  return forces;
}

std::vector<GrainVector> ForceField::wall_forces_3d() {
  see_walls_as_they_are();
  const Grains& balls = place_discs();
  Forces3d on_balls;
  resize(on_balls, balls.size(), model_.kernels->effects.rotation);
  add_wall_forces(press_walls(part_3d_, balls), model_.kernels->effects.rotation, on_balls);
  return on_balls.forces;
}

DeepestContact ForceField::deepest_contact() {
  const Grains& discs = place_discs();
  const auto grain_of = [&](int k) { return clumps_ ? discs.clump[static_cast<std::size_t>(k)] : k; };
  DeepestContact deepest;
  const auto look = [&](int i, int j, double overlap, const GrainKind& one, double compliance, double curvature,
                        double inverse_mass) {
    const double relative = overlap * one.compliance / (one.compliance + compliance) / one.radius;
    if (relative <= deepest.relative_overlap && deepest.grain >= 0) return;
    deepest = {grain_of(i),
               j < 0 ? j : grain_of(j),
               relative,
               overlap,
               model_.law->stiffness(one.compliance, compliance, 1 / one.radius, curvature),
               one.inverse_mass + inverse_mass};
  };
  const auto look_at_pairs = [&](const PairList& pairs, const Neighbours::Image& shift) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const int i = pairs.grain[k], j = pairs.partner[k];
      const std::size_t a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const GrainKind one = discs.kind(a), other = discs.kind(b);
      const double dx = discs.x[b] - (discs.x[a] + shift.x), dy = discs.y[b] - discs.y[a];
      const double dz = discs.is_3d ? discs.z[b] - (discs.z[a] + shift.z) : 0;
      const double overlap = one.radius + other.radius - std::sqrt(dx * dx + dy * dy + dz * dz);
      look(i, j, overlap, one, other.compliance, 1 / other.radius, other.inverse_mass);
      look(j, i, overlap, other, one.compliance, 1 / one.radius, one.inverse_mass);
    }
  };
  look_at_pairs(state_.contacts.pairs, {0, 0});
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k)
    look_at_pairs(state_.contacts.boundaries[k].pairs, neighbours_.images()[k]);
  for (const WallCandidate& near : state_.contacts.walls) {
    const std::size_t i = static_cast<std::size_t>(near.grain);
    const GrainKind kind = discs.kind(i);
    const double apart = std::sqrt(walls_.distance2(static_cast<std::size_t>(near.wall), discs.place(i)));
    look(near.grain, -1, kind.radius - apart, kind, model_.contacts.wall_compliance, 0, 0);
  }
  return deepest;
}

std::vector<char> ForceField::touching() {
  std::vector<char> touches(state_.grains.size(), 0);
  const Grains& discs = place_discs();
  const auto grain_of = [&](std::size_t k) { return clumps_ ? static_cast<std::size_t>(discs.clump[k]) : k; };
  const auto look = [&](const PairList& pairs, const Neighbours::Image& shift) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::size_t i = static_cast<std::size_t>(pairs.grain[k]), j = static_cast<std::size_t>(pairs.partner[k]);
      const double reach = discs.kind(i).radius + discs.kind(j).radius;
      const double dx = discs.x[j] - (discs.x[i] + shift.x), dy = discs.y[j] - discs.y[i];
      const double dz = discs.is_3d ? discs.z[j] - (discs.z[i] + shift.z) : 0;
      if (dx * dx + dy * dy + dz * dz < reach * reach) touches[grain_of(i)] = touches[grain_of(j)] = 1;
    }
  };
  look(state_.contacts.pairs, {0, 0});
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k)
    look(state_.contacts.boundaries[k].pairs, neighbours_.images()[k]);
  return touches;
}

void ForceField::grains_added() {
  clumps_are_current_ = false;
  neighbours_.start_afresh();
}

void ForceField::grains_wrapped() {
  neighbours_.start_afresh_across();
  neighbours_.update(place_discs(), walls_, state_.vessels.placed_at, state_.contacts);
}

void ForceField::remove_flagged(const std::vector<char>& removed) {
  clumps_are_current_ = false;
  neighbours_.remove_flagged(clumps_ ? clumps_->flags_of_discs(removed) : removed, state_.contacts);
}

void ForceField::remove_wall(std::size_t wall) {
  state_.vessels.removed[wall] = 1;
  walls_.remove(wall);
  neighbours_.remove_wall(static_cast<int>(wall), state_.contacts);
}

void ForceField::restore_wall(std::size_t wall) {
  state_.vessels.removed[wall] = 0;
  walls_.restore(wall);
  walls_.place(state_.vessels.placed_at);
  neighbours_.restore_wall(static_cast<int>(wall));
}

void ForceField::set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion,
                            const Eigen::Vector2d& shift) {
  state_.vessels.motion[vessel] = motion, state_.vessels.shift[vessel] = shift;
  walls_.set_motion(vessel, motion, shift);
}

}  // namespace vibrosow
