// How ForceField's kernels see the grains move.
#include "simulation/force_field.hpp"

namespace vibrosow {

Motion ForceField::motion_of(const Part<Discs2d>& /*part*/, const Grains& discs) const {
  return {discs.x.data(), discs.y.data(), discs.vx.data(), discs.vy.data(), discs.omega.data(), discs.x.data()};
}

Motion ForceField::across(const Motion& at, const Grains& discs, const Neighbours::Image& image) {
  shifted_x_ = discs.x;
  for (double& x : shifted_x_) x += image.x;
  Motion shifted = at;
  shifted.row_x = shifted_x_.data();
  return shifted;
}

BallRows ForceField::rows_to_set() {
  places_.resize(state_.grains.size()), motions_.resize(state_.grains.size());
  rows_are_set_ = true;
  return {places_.data(), motions_.data()};
}

/// What it points at is right until it is asked for again.
Motion3d ForceField::motion_of(const Part<Balls3d>& /*part*/, const Grains& balls) {
  if (clumps_) return {clumps_->places().data(), clumps_->places().data(), clumps_->motions().data()};
  if (!rows_are_set_) set_rows(balls);
  rows_are_set_ = false;
  return {places_.data(), places_.data(), motions_.data()};
}

void ForceField::set_rows(const Grains& balls) {
  const BallRows rows = rows_to_set();
  const bool turn = !balls.omega.empty();
  execution_.share(balls.size(), [&](std::size_t a, std::size_t b) {
    const Loops3d& loops = execution_.loops_3d();
    loops.places_to_rows(b - a, {&balls.x[a], &balls.y[a], &balls.z[a]}, rows.places + a);
    const Coordinates spin = turn ? Coordinates{&balls.omega_x[a], &balls.omega_y[a], &balls.omega[a]} : Coordinates{};
    loops.motions_to_rows(b - a, {&balls.vx[a], &balls.vy[a], &balls.vz[a]}, spin, rows.motions + a);
  });
}

Motion3d ForceField::across(const Motion3d& at, const Grains& /*balls*/, const Neighbours::Image& image) {
  shifted_places_ = clumps_ ? clumps_->places() : places_;
  for (GrainVector& place : shifted_places_) place.x += image.x, place.z += image.z;
  return {at.place, shifted_places_.data(), at.motion};
}

}  // namespace vibrosow
