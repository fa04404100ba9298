#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"

namespace vibrosow {

/// Which of the walls that a grain touches push it, in 2D and in 3D. A wall touches with the point of it that
/// is nearest to the grain's centre. Two walls are of one surface where a grain's centre sees such points of theirs in
/// directions less than 10 degrees apart, or where an end or edge lies nearer than 1e-3 of the grain's radius to a face
/// that is touched: a plate drawn twice, lines that a curve was drawn as, a line on a floor, an edge that two plates
/// share, a wall's end in the middle of another. Walls that are each of one surface with the next are so together, and
/// the nearest of them pushes, as it would of a curve; of those as near as it (to 1e-9 of the radius) a face before an
/// end, then the first. It does not matter whose walls they are or how they move: what counts is where they are now.
///
/// Walls of the surface of one that pushes share its history, so that springs go on where it ends and they do not, or
/// where a gate among them opens.
class WallTouches {
 public:
  /// A wall that a grain touches: `candidate` of the range that is looked through.
  struct Touch {
    std::size_t candidate;
    Eigen::Vector3d apart;  // m, from the grain's centre to the wall's point
    double distance;        // m, its length
    bool inside;            // whether the point lies inside the wall: a face, not an end or an edge
  };

  /// Nothing touches yet; `count` candidates, which are numbered from `first` among all.
  void begin(std::size_t first, std::size_t count);

  /// Calls `push(c)` for each of the candidates that touch, `near` (sorted by grain), which pushes; of one grain faces
  /// first, else in their order. `touch_of(c)`: how it touches; `radius_of(i)`: m, of grain i; `from_wall(c, apart)`:
  /// distance squared (m2) of a place, seen from the grain's centre, from the wall.
  template <class TouchOf, class RadiusOf, class FromWall, class Push>
  void push_each(std::span<const WallCandidate> candidates, std::span<const std::size_t> near, TouchOf touch_of,
                 RadiusOf radius_of, FromWall from_wall, Push push);

  /// Before histories move on: a wall that pushes in another's place takes what that one had, and candidates that
  /// touched before and do not now have none.
  void renew(ContactHistories& histories) const;

  /// After they have moved on: walls that lie on one that pushes have its history.
  void share(ContactHistories& histories) const;

 private:
  /// A face that is touched but does not push, and the candidate that pushes in its place.
  struct Twin {
    std::size_t candidate, pusher;
  };
  void add(std::size_t candidate) { touches_[candidate] = 1; }
  template <class FromWall>
  void choose(double radius, FromWall from_wall);
  /// Sets `sorted_`: the nearest first.
  void sort_by_distance(double radius);
  /// From `pusher_of_`.
  void take_chosen();

  std::size_t first_ = 0;
  std::vector<unsigned char> touches_;  // by candidate: whether it pushes or lies on one that does
  std::vector<Touch> touched_;          // by one grain
  std::vector<std::size_t> sorted_;     // their indices
  std::vector<std::size_t> pusher_of_;  // index of the one that pushes in the place of each, which may be itself
  std::vector<Touch> pushing_;
  std::vector<Twin> twins_;  // of all grains
};

template <class TouchOf, class RadiusOf, class FromWall, class Push>
void WallTouches::push_each(std::span<const WallCandidate> candidates, std::span<const std::size_t> near,
                            TouchOf touch_of, RadiusOf radius_of, FromWall from_wall, Push push) {
  for (std::size_t from = 0, to = 0; from < near.size(); from = to) {
    const int grain = candidates[near[from]].grain;
    while (to < near.size() && candidates[near[to]].grain == grain) ++to;
    if (to == from + 1) {
      add(near[from]);
      push(near[from]);
      continue;
    }
    touched_.clear();
    for (std::size_t k = from; k < to; ++k) touched_.push_back(touch_of(near[k]));
    choose(radius_of(static_cast<std::size_t>(grain)), from_wall);
    for (const Touch& one : pushing_) push(one.candidate);
  }
}

/// Of what is `touched_`, sets what is `pushing_`.
template <class FromWall>
void WallTouches::choose(double radius, FromWall from_wall) {
  constexpr double same_place = 1e-3;                 // of the radius
  constexpr double same_direction = 0.9848077530122;  // cosine of 10 degrees
  const auto are_one = [&](const Touch& one, const Touch& other) {
    if (one.apart.dot(other.apart) >= same_direction * one.distance * other.distance) return true;
    if (one.inside == other.inside) return false;
    const Touch &face = one.inside ? one : other, &end = one.inside ? other : one;
    return from_wall(face.candidate, end.apart) <= same_place * same_place * radius * radius;
  };
  sort_by_distance(radius);
  pusher_of_.resize(touched_.size());
  for (std::size_t k = 0; k < sorted_.size(); ++k) {
    const std::size_t one = sorted_[k];
    pusher_of_[one] = one;
    for (std::size_t nearer = 0; nearer < k && pusher_of_[one] == one; ++nearer)
      if (are_one(touched_[one], touched_[sorted_[nearer]])) pusher_of_[one] = pusher_of_[sorted_[nearer]];
  }
  take_chosen();
}

}  // namespace vibrosow
