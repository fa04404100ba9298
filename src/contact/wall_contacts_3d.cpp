#include "contact/wall_contacts_3d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vessel/directions.hpp"

namespace vibrosow {
namespace {

Eigen::Vector3d centre_of(const Grains& grains, std::size_t i) {
  return {grains.x[i], grains.y[i], grains.z[i]};
}
double radius_of(const Grains& grains, std::size_t i) {
  return grains.polydisperse ? grains.radius[i] : grains.kinds.front().radius;
}

GrainVector row_of(const Eigen::Vector3d& direction, const Eigen::Vector3d& origin) {
  return {direction.x(), direction.y(), direction.z(), -direction.dot(origin)};
}

PlateRows rows_of(const PlacedFace& face) {
  const Face& own = *face.own;
  if (own.kind != Face::Kind::plate) return {};
  PlateRows rows;
  rows.normal = row_of(face.normal, face.origin);
  rows.e1 = row_of(face.e1, face.origin), rows.e2 = row_of(face.e2, face.origin);
  if (!own.round) rows.sides = {own.length_u, own.length_v, 0, 0};
  constexpr double far = std::numeric_limits<double>::infinity();
  rows.holes = {far, -far, far, -far};
  for (const RoundHole& hole : own.holes) {
    auto& [from_u, to_u, from_v, to_v] = rows.holes;
    from_u = std::min(from_u, hole.u - hole.radius), to_u = std::max(to_u, hole.u + hole.radius);
    from_v = std::min(from_v, hole.v - hole.radius), to_v = std::max(to_v, hole.v + hole.radius);
  }
  return rows;
}

void put(VectorColumns& columns, std::size_t k, const Eigen::Vector3d& vector) {
  columns.x[k] = vector.x(), columns.y[k] = vector.y(), columns.z[k] = vector.z();
}

void add(const WallCandidate& candidate, std::size_t c, const NearestOnFace& nearest, const PlacedFace& face,
         const Eigen::Vector3d& centre, WallContacts3d& contacts) {
  const std::size_t k = static_cast<std::size_t>(contacts.count++);
  contacts.candidate[k] = static_cast<int>(c), contacts.grain[k] = candidate.grain;
  const double distance = std::sqrt(nearest.distance2);
  contacts.distance[k] = distance;
  // Where the centre lies on the face it is pushed back to the side it came from.
  const Eigen::Vector3d normal =
      distance > 0 ? Eigen::Vector3d(nearest.apart / distance)
                   : Eigen::Vector3d(std::copysign(1.0, -candidate.side) * face_normal_at(face, centre));
  put(contacts.normal, k, normal);
  const bool turns = !face.now.spin.isZero(0) || !face.on_mean.spin.isZero(0);
  const Eigen::Vector3d point = centre + nearest.apart;
  put(contacts.wall_velocity, k, turns ? face.now.at(point) : face.now.velocity);
  put(contacts.mean_wall_velocity, k, turns ? face.on_mean.at(point) : face.on_mean.velocity);
  put(contacts.wall_spin, k, face.on_mean.spin);
}

void make_room(std::size_t most, WallContacts3d& contacts) {
  if (contacts.grain.size() >= most) return;
  contacts.candidate.resize(most), contacts.grain.resize(most), contacts.distance.resize(most);
  for (VectorColumns* columns : {&contacts.normal, &contacts.wall_velocity, &contacts.mean_wall_velocity,
                                 &contacts.wall_spin, &contacts.force, &contacts.torque})
    columns->resize(most);
}

}  // namespace

/// The nearest point of the face of a candidate of the range, which is not clear of it.
NearestOnFace WallFinder3d::nearest(const PlacedFace& face, const Eigen::Vector3d& centre, std::size_t c) const {
  if (stands_[c] != OverPlate::flat) return nearest_on_face(face, centre);
  return {-height_[c] * face.normal, height_[c] * height_[c], true, height_[c]};
}

void WallFinder3d::find(const Grains& grains, std::span<const WallCandidate> candidates, std::size_t first,
                        const std::vector<PlacedFace>& faces, WallContacts3d& contacts) {
  const std::size_t count = candidates.size();
  make_room(count, contacts);
  contacts.count = 0;
  nearest_.resize(count), height_.resize(count), stands_.resize(count), close_.clear(), near_.clear();
  touches_.begin(first, count);
  plates_.clear();
  for (const PlacedFace& face : faces) plates_.push_back(rows_of(face));
  const PerGrain radius{grains.polydisperse ? grains.radius.data() : nullptr, grains.kinds.front().radius};
  over_plates_(count, candidates.data(), {grains.x.data(), grains.y.data(), grains.z.data()}, radius, plates_.data(),
               height_.data(), stands_.data());
  const auto grain_of = [&](std::size_t c) { return static_cast<std::size_t>(candidates[c].grain); };
  const auto face_of = [&](std::size_t c) -> const PlacedFace& {
    return faces[static_cast<std::size_t>(candidates[c].wall)];
  };
  for (std::size_t c = 0; c < count; ++c) {
    if (stands_[c] == OverPlate::clear) continue;
    const double reach = radius_of(grains, grain_of(c));
    close_.push_back(c);
    nearest_[c] = nearest(face_of(c), centre_of(grains, grain_of(c)), c);
    if (nearest_[c].distance2 < reach * reach) near_.push_back(c);
  }
  const auto touch_of = [&](std::size_t c) {
    const NearestOnFace& nearest = nearest_[c];
    return WallTouches::Touch{c, nearest.apart, std::sqrt(nearest.distance2), nearest.inside};
  };
  const auto from_wall = [&](std::size_t c, const Eigen::Vector3d& apart) {
    return nearest_on_face(face_of(c), centre_of(grains, grain_of(c)) + apart).distance2;
  };
  const auto push = [&](std::size_t c) {
    add(candidates[c], first + c, nearest_[c], face_of(c), centre_of(grains, grain_of(c)), contacts);
  };
  touches_.push_each(
      candidates, near_, touch_of, [&](std::size_t i) { return radius_of(grains, i); }, from_wall, push);
}

void WallFinder3d::watch_crossings(std::span<WallCandidate> candidates, std::vector<int>& crossed) const {
  for (const std::size_t c : close_) {
    if (!nearest_[c].inside)
      candidates[c].side = nearest_[c].side;
    else if (nearest_[c].side * candidates[c].side < 0)
      crossed.push_back(candidates[c].grain);
  }
}

void add_wall_forces(const WallContacts3d& contacts, bool rotation, Forces3d& forces) {
  const std::size_t count = static_cast<std::size_t>(contacts.count);
  const auto add_up = [](const VectorColumns& columns, std::size_t k, GrainVector& sum) {
    sum.x += columns.x[k], sum.y += columns.y[k], sum.z += columns.z[k];
  };
  for (std::size_t k = 0; k < count;) {
    const std::size_t i = static_cast<std::size_t>(contacts.grain[k]);
    GrainVector force{}, torque{};
    for (; k < count && contacts.grain[k] == static_cast<int>(i); ++k) {
      add_up(contacts.force, k, force);
      if (rotation) add_up(contacts.torque, k, torque);
    }
    const auto add = [](const GrainVector& of, GrainVector& sum) { sum.x += of.x, sum.y += of.y, sum.z += of.z; };
    add(force, forces.forces[i]);
    if (rotation) add(torque, forces.torques[i]);
  }
}

void add_wall_power(const WallContacts3d& contacts, double& power) {
  const VectorColumns &f = contacts.force, &v = contacts.wall_velocity;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contacts.count); ++k)
    power += f.x[k] * v.x[k] + f.y[k] * v.y[k] + f.z[k] * v.z[k];
}

}  // namespace vibrosow
