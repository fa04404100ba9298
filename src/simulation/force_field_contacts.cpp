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

Vector force_on(const Forces& sums, std::size_t i) {
  return {sums[i].fx, sums[i].fy, 0};
}
Vector force_on(const Forces3d& sums, std::size_t i) {
  return {sums.forces[i].x, sums.forces[i].y, sums.forces[i].z};
}

}  // namespace

/// The kernels work out the forces, of one pair at a time: what its grain then has is this contact's.
template <class In>
void ForceField::add_contacts(Part<In>& part, const Grains& discs, const typename In::Moving& at, const PairList& pairs,
                              ContactHistories& histories, const Neighbours::Image& image,
                              std::vector<GrainContact>& contacts) {
  resize(part.on_discs, discs.size(), model_.kernels->effects.rotation);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int entry = static_cast<int>(k), grain = pairs.grain[k], partner = pairs.partner[k];
    const std::size_t i = static_cast<std::size_t>(grain), j = static_cast<std::size_t>(partner);
    const Vector to = discs.place(j), from = discs.place(i) + Vector(image.x, 0, image.z);
    const double overlap = discs.kind(i).radius + discs.kind(j).radius - (to - from).norm();
    if (!(overlap > 0)) continue;
    for (const int n : {grain, partner}) begin_with_zero(part.on_discs, {n, n + 1});
    auto result = result_in(part.on_discs, 0);
    part.kernels.pair(surfaces_of(discs), at, pairs, {entry, entry + 1}, model_.contacts, {}, histories, result);
    contacts.push_back(contact_of(id_of_disc(discs, i), id_of_disc(discs, j), from, to, direction(to - from),
                                  force_on(part.on_discs, i), overlap));
  }
}

void ForceField::add_wall_contacts(const WallContacts& w, const Grains& discs,
                                   std::vector<GrainContact>& contacts) const {
  for (std::size_t k = 0; k < static_cast<std::size_t>(w.count); ++k) {
    const std::size_t i = static_cast<std::size_t>(w.grain[k]);
    const Vector from = discs.place(i), apart(w.dx[k], w.dy[k], 0);
    const Vector normal = w.distance2[k] > 0 ? direction(apart) : Vector(w.normal_x[k], w.normal_y[k], 0);
    contacts.push_back(contact_of(id_of_disc(discs, i), -1, from, from + apart, normal, Vector(-w.fx[k], -w.fy[k], 0),
                                  discs.kind(i).radius - apart.norm()));
  }
}

void ForceField::add_wall_contacts(const WallContacts3d& w, const Grains& balls,
                                   std::vector<GrainContact>& contacts) const {
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

template <class In>
std::vector<GrainContact> ForceField::contacts_of(Part<In>& part, const Grains& discs) {
  std::vector<GrainContact> contacts;
  const typename In::Moving at = motion_of(part, discs);
  add_contacts(part, discs, at, state_.contacts.pairs, state_.contacts.pair_histories, {0, 0}, contacts);
  for (std::size_t k = 0; k < neighbours_.images().size(); ++k) {
    BoundaryContacts& boundary = state_.contacts.boundaries[k];
    const Neighbours::Image& image = neighbours_.images()[k];
    add_contacts(part, discs, across(at, discs, image), boundary.pairs, boundary.histories, image, contacts);
  }
  add_wall_contacts(press_walls(part, discs), discs, contacts);
  return contacts;
}

std::vector<GrainContact> ForceField::contacts() {
  see_walls_as_they_are();
  const Grains& discs = place_discs();
  return with_part([&](auto& part) { return contacts_of(part, discs); });
}

}  // namespace vibrosow
