// ForceField's part for balls in space.
#include <algorithm>

#include "simulation/force_field.hpp"

namespace vibrosow {

namespace {

/// Runs a kernel over the pairs of a range, block by block; what it leaves for others goes to `foreign`.
void add_pairs(SpacePairKernel kernel, const GrainSurfaces& surfaces, const SpaceMotion& at, const PairList& list,
               PairRange range, const ContactParameters& parameters, const ContactStep& step,
               ContactHistories& histories, SpacePairResult& result, std::vector<ForeignSpaceForce>& foreign,
               ContactStatistics& statistics) {
  for (int from = range.from; from < range.to; from += pair_block_size) {
    kernel(surfaces, at, list, {from, std::min(from + pair_block_size, range.to)}, parameters, step, histories, result);
    foreign.insert(foreign.end(), result.foreign, result.foreign + result.foreign_count);
    statistics.contacts += result.contacts;
    add_figures(result.figures, statistics);
  }
}

}  // namespace

BallRows ForceField::rows_to_set() {
  places_.resize(state_.grains.size()), motions_.resize(state_.grains.size());
  rows_are_set_ = true;
  return {places_.data(), motions_.data()};
}

/// What it points at is right until it is asked for again.
SpaceMotion ForceField::motion_in_space(const Grains& balls) {
  if (clumps_) return {clumps_->places().data(), clumps_->places().data(), clumps_->motions().data()};
  if (!rows_are_set_) set_rows(balls);
  rows_are_set_ = false;
  return {places_.data(), places_.data(), motions_.data()};
}

void ForceField::set_rows(const Grains& balls) {
  const BallRows rows = rows_to_set();
  const bool turn = !balls.omega.empty();
  execution_.share(balls.size(), [&](std::size_t a, std::size_t b) {
    const SpaceLoops& loops = execution_.space_loops();
    loops.places_to_rows(b - a, {&balls.x[a], &balls.y[a], &balls.z[a]}, rows.places + a);
    const Coordinates spin = turn ? Coordinates{&balls.omega_x[a], &balls.omega_y[a], &balls.omega[a]} : Coordinates{};
    loops.motions_to_rows(b - a, {&balls.vx[a], &balls.vy[a], &balls.vz[a]}, spin, rows.motions + a);
  });
}

SpaceMotion ForceField::motion_of_image(const SpaceMotion& at, const Neighbours::Image& image) {
  shifted_places_ = clumps_ ? clumps_->places() : places_;
  for (GrainVector& place : shifted_places_) place.x += image.x, place.z += image.z;
  return {at.place, shifted_places_.data(), at.motion};
}

/// As in the plane, range by range.
void ForceField::set_pair_forces_in_space(const Grains& balls, const SpaceMotion& at, const ContactStep& step,
                                          SpaceForces& all, ContactStatistics& statistics) {
  const GrainSurfaces surfaces = surfaces_of(balls);
  all.forces.resize(balls.size()), all.torques.resize(model_.kernels->effects.rotation ? balls.size() : 0);
  execution_.for_each_range([&](int k) {
    const std::size_t range = static_cast<std::size_t>(k);
    const auto [own_grains, entries] = pair_share(range, balls.size());
    RangeWork& own = ranges_[range];
    own.foreign_in_space.clear();
    own.statistics = {};
    for (std::vector<GrainVector>* sums : {&all.forces, &all.torques})
      if (!sums->empty()) std::fill(sums->begin() + own_grains.from, sums->begin() + own_grains.to, GrainVector{});
    SpacePairResult result;
    result.forces = all.forces.data(), result.torques = all.torques.data();
    result.first_own = own_grains.from;
    add_pairs(space_pair_kernel_, surfaces, at, state_.contacts.pairs, entries, model_.contacts, step,
              state_.contacts.pair_histories, result, own.foreign_in_space, own.statistics);
  });
  add_up_ranges(statistics);
  for (const RangeWork& own : ranges_) {
    for (const ForeignSpaceForce& foreign : own.foreign_in_space) {
      const std::size_t i = static_cast<std::size_t>(foreign.grain);
      GrainVector& force = all.forces[i];
      force.x += foreign.force[0], force.y += foreign.force[1], force.z += foreign.force[2];
      if (all.torques.empty()) continue;
      GrainVector& torque = all.torques[i];
      torque.x += foreign.torque[0], torque.y += foreign.torque[1], torque.z += foreign.torque[2];
    }
  }
}

void ForceField::run_kernels_in_space(const Grains& balls, const ContactStep& step, SpaceForces& all,
                                      ContactStatistics& statistics) {
  const SpaceMotion at = motion_in_space(balls);
  set_pair_forces_in_space(balls, at, step, all, statistics);
  const GrainSurfaces surfaces = surfaces_of(balls);
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k) {
    BoundaryContacts& boundary = state_.contacts.boundaries[k];
    SpacePairResult result;
    result.forces = all.forces.data(), result.torques = all.torques.data(), result.first_own = 0;
    add_pairs(space_pair_kernel_, surfaces, motion_of_image(at, neighbours_.images()[k]), boundary.pairs,
              {0, static_cast<int>(boundary.pairs.size())}, model_.contacts, step, boundary.histories, result,
              ranges_.front().foreign_in_space, statistics);
  }
  execution_.profile().lap(Phase::pairs);
  const auto add = [&](const SpaceWallContacts& touching) {
    add_wall_forces(touching, model_.kernels->effects.rotation, all.forces, all.torques);
  };
  add_walls(&RangeWork::space_walls, balls, walls_.placed_faces(), space_wall_kernel_, at, step, add, statistics);
  execution_.profile().lap(Phase::walls);
}

/// All of them in one range.
SpaceWallContacts& ForceField::find_wall_contacts_in_space(const Grains& balls) {
  RangeWork& only = ranges_.front();
  only.space_walls.finder.find(balls, state_.contacts.walls, 0, walls_.placed_faces(), only.space_walls.contacts);
  return only.space_walls.contacts;
}

double ForceField::elastic_energy_in_space(const Grains& balls) {
  const GrainSurfaces surfaces = surfaces_of(balls);
  const SpaceEnergyKernel& energies = model_.kernels->energy_in_space;
  const SpaceMotion at = motion_in_space(balls);
  double energy = energies.pair(surfaces, at, state_.contacts.pairs, model_.contacts, state_.contacts.pair_histories);
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k) {
    const BoundaryContacts& boundary = state_.contacts.boundaries[k];
    energy += energies.pair(surfaces, motion_of_image(at, neighbours_.images()[k]), boundary.pairs, model_.contacts,
                            boundary.histories);
  }
  return energy +
         energies.wall(surfaces, find_wall_contacts_in_space(balls), model_.contacts, state_.contacts.wall_histories);
}

std::vector<GrainVector> ForceField::wall_forces_in_space() {
  see_walls_as_they_are();
  const Grains& balls = place_discs();
  std::vector<GrainVector> forces(balls.size()), torques(balls.size());
  SpaceWallContacts& touching = find_wall_contacts_in_space(balls);
  space_wall_kernel_(surfaces_of(balls), motion_in_space(balls), model_.contacts, {}, state_.contacts.wall_histories,
                     touching);
  add_wall_forces(touching, model_.kernels->effects.rotation, forces, torques);
  return forces;
}

}  // namespace vibrosow
