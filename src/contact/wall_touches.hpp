#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"

namespace vibrosow {

/// Which of the walls that a grain touches push it, in 2D and in 3D. A wall touches with the point of it that
/// is nearest to the grain's centre. Where such points of two walls lie nearer to each other than 1e-3 of the grain's
/// radius, or an end or edge lies so near to a face that is touched, there is one surface: a plate drawn twice, a line
/// on a floor, an edge that two plates share, a wall's end in the middle of another. Of these the nearest pushes; of
/// those as near as it (to 1e-9 of the radius) a face before an end, then the first. It does not matter whose walls
/// they are or how they move: what counts is where they are now.
///
/// Walls that lie on one that pushes share its history, so that springs go on where it ends and they do not, or where
/// a gate among them opens.
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
  void replace(std::size_t pushing, const Touch& by, std::size_t first_twin);

  std::size_t first_ = 0;
  std::vector<unsigned char> touches_;  // by candidate: whether it pushes or lies on one that does
  std::vector<Touch> touched_;          // by one grain
  std::vector<Touch> pushing_;          // of these
  std::vector<Twin> twins_;             // of all grains
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
  constexpr double same_place = 1e-3, as_near = 1e-9;  // of the radius
  const std::size_t first_twin = twins_.size();
  const auto is_on = [&](const Touch& one, const Touch& other) {
    const double distance2 =
        other.inside && !one.inside ? from_wall(other.candidate, one.apart) : (one.apart - other.apart).squaredNorm();
    return distance2 <= same_place * same_place * radius * radius;
  };
  const auto is_known = [&](const Touch& one) {
    for (const Touch& other : pushing_) {
      if (!is_on(one, other) || other.distance > one.distance + as_near * radius) continue;
      if (one.inside) twins_.push_back({one.candidate, other.candidate});
      return true;
    }
    return false;
  };
  pushing_.clear();
  for (const bool inside : {true, false})
    for (const Touch& one : touched_) {
      if (one.inside != inside || is_known(one)) continue;
      for (std::size_t k = pushing_.size(); k-- > 0;)
        if (is_on(one, pushing_[k])) replace(k, one, first_twin);
      pushing_.push_back(one);
    }
  for (const Touch& one : pushing_) add(one.candidate);
  for (std::size_t k = first_twin; k < twins_.size(); ++k) add(twins_[k].candidate);
}

}  // namespace vibrosow
