// ForceField's contacts one by one, for those who look at a run.
#include <cmath>

#include "simulation/force_field.hpp"

namespace vibrosow {
namespace {

using Vector = Eigen::Vector3d;

std::array<double, 3> as_array(const Vector& v) {
  return {v.x(), v.y(), v.z()};
}

/// `normal`: unit vector from the grain to what it touches.
GrainContact contact_of(std::int64_t grain, std::int64_t partner, const Vector& from, const Vector& to,
                        const Vector& normal, const Vector& force, double overlap) {
  const Vector along = force.dot(normal) * normal;
  return {grain, partner, as_array(from), as_array(to), as_array(along), as_array(force - along), overlap};
}

/// Coincident centres have the normal that the kernels give them.
Vector direction(const Vector& apart) {
  const double distance = apart.norm();
  return distance > 0 ? Vector(apart / distance) : Vector(Vector::UnitX());
}

}  // namespace

/// The kernels work out the forces, of one pair at a time: what its grain then has is this contact's.
Eigen::Vector3d ForceField::force_of_pair_in_space(const Grains& balls, const SpaceMotion& at, const PairList& pairs,
                                                   ContactHistories& histories, std::size_t k) {
  const int entry = static_cast<int>(k);
  const std::size_t i = static_cast<std::size_t>(pairs.grain[k]), j = static_cast<std::size_t>(pairs.partner[k]);
  ball_forces_.forces.resize(balls.size()), ball_forces_.torques.resize(balls.size());
  for (const std::size_t n : {i, j}) ball_forces_.forces[n] = ball_forces_.torques[n] = {};
  SpacePairResult result;
  result.forces = ball_forces_.forces.data(), result.torques = ball_forces_.torques.data(), result.first_own = 0;
  space_pair_kernel_(surfaces_of(balls), at, pairs, {entry, entry + 1}, model_.contacts, {}, histories, result);
  const GrainVector& force = ball_forces_.forces[i];
  return {force.x, force.y, force.z};
}

Eigen::Vector3d ForceField::force_of_pair(const Grains& discs, const Motion& at, const PairList& pairs,
                                          ContactHistories& histories, std::size_t k) {
  const int entry = static_cast<int>(k);
  const std::size_t i = static_cast<std::size_t>(pairs.grain[k]), j = static_cast<std::size_t>(pairs.partner[k]);
  disc_forces_.resize(discs.size());
  disc_forces_[i] = disc_forces_[j] = {};
  PairResult result;
  result.forces = disc_forces_.data(), result.first_own = 0;
  pair_kernel_(surfaces_of(discs), at, pairs, {entry, entry + 1}, model_.contacts, {}, histories, result);
  return {disc_forces_[i].fx, disc_forces_[i].fy, 0};
}

void ForceField::add_contacts(const Grains& discs, const PairList& pairs, ContactHistories& histories,
                              const Neighbours::Image& image, std::vector<GrainContact>& contacts) {
  const bool across = image.x != 0 || image.z != 0, in_space = discs.in_space;
  SpaceMotion at_in_space{};
  if (in_space) at_in_space = motion_in_space(discs);
  if (in_space && across) at_in_space = motion_of_image(at_in_space, image);
  Motion at{};
  if (!in_space) at = across ? across_boundary(discs, image.x) : motion_of(discs);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(pairs.grain[k]), j = static_cast<std::size_t>(pairs.partner[k]);
    const Vector to = discs.place(j), from = discs.place(i) + Vector(image.x, 0, image.z);
    const double overlap = discs.kind(i).radius + discs.kind(j).radius - (to - from).norm();
    if (!(overlap > 0)) continue;
    const Vector force = in_space ? force_of_pair_in_space(discs, at_in_space, pairs, histories, k)
                                  : force_of_pair(discs, at, pairs, histories, k);
    contacts.push_back(
        contact_of(id_of_disc(discs, i), id_of_disc(discs, j), from, to, direction(to - from), force, overlap));
  }
}

void ForceField::add_wall_contacts(const Grains& discs, std::vector<GrainContact>& contacts) {
  WallContacts& w = find_wall_contacts(discs);
  wall_kernel_(surfaces_of(discs), motion_of(discs), model_.contacts, {}, state_.contacts.wall_histories, w);
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.count); ++k) {
    const std::size_t i = static_cast<std::size_t>(w.grain[k]);
    const Vector from = discs.place(i), apart(w.dx[k], w.dy[k], 0);
    const Vector normal = w.distance2[k] > 0 ? direction(apart) : Vector(w.normal_x[k], w.normal_y[k], 0);
    contacts.push_back(contact_of(id_of_disc(discs, i), -1, from, from + apart, normal, Vector(-w.fx[k], -w.fy[k], 0),
                                  discs.kind(i).radius - apart.norm()));
  }
}

void ForceField::add_face_contacts(const Grains& balls, std::vector<GrainContact>& contacts) {
  SpaceWallContacts& w = find_wall_contacts_in_space(balls);
  space_wall_kernel_(surfaces_of(balls), motion_in_space(balls), model_.contacts, {}, state_.contacts.wall_histories,
                     w);
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.count); ++k) {
    const std::size_t i = static_cast<std::size_t>(w.grain[k]);
    const Vector from = balls.place(i), normal(w.normal.x[k], w.normal.y[k], w.normal.z[k]);
    contacts.push_back(contact_of(id_of_disc(balls, i), -1, from, from + w.distance[k] * normal, normal,
                                  {w.force.x[k], w.force.y[k], w.force.z[k]}, balls.kind(i).radius - w.distance[k]));
  }
}

std::int64_t ForceField::id_of_disc(const Grains& discs, std::size_t i) const {
  return clumps_ ? state_.grains.id[static_cast<std::size_t>(discs.clump[i])] : discs.id[i];
}

std::vector<GrainContact> ForceField::contacts() {
  see_walls_as_they_are();
  const Grains& discs = place_discs();
  std::vector<GrainContact> contacts;
  add_contacts(discs, state_.contacts.pairs, state_.contacts.pair_histories, {0, 0}, contacts);
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k) {
    BoundaryContacts& boundary = state_.contacts.boundaries[k];
    add_contacts(discs, boundary.pairs, boundary.histories, neighbours_.images()[k], contacts);
  }
  discs.in_space ? add_face_contacts(discs, contacts) : add_wall_contacts(discs, contacts);
  return contacts;
}

}  // namespace vibrosow
