#pragma once

#include <box2d/box2d.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "box2d/broadphase.hpp"
#include "contact/contact_list.hpp"

namespace vibrosow {

inline constexpr std::size_t cluster_size = 8;  // neighbouring grains

/// Box2D's tree, with a box for each cluster.
class ClusterTree {
 public:
  /// `box_of(c)`: that of each cluster c below `count`.
  template <class BoxOf>
  void update(std::size_t count, BoxOf box_of) {
    while (proxies_.size() > count) tree_.DestroyProxy(proxies_.back()), proxies_.pop_back();
    for (std::size_t c = 0; c < count; ++c) {
      if (c < proxies_.size())
        tree_.MoveProxy(proxies_[c], box_of(c), b2Vec2(0, 0));
      else
        proxies_.push_back(tree_.CreateProxy(box_of(c), nullptr));
      const std::size_t proxy = static_cast<std::size_t>(proxies_[c]);
      if (cluster_of_proxy_.size() <= proxy) cluster_of_proxy_.resize(proxy + 1);
      cluster_of_proxy_[proxy] = static_cast<int>(c);
    }
  }

  /// `meet(c)` for each cluster c whose box meets `box`.
  template <class Meet>
  void query(const b2AABB& box, Meet meet) const {
    struct Callback {
      const ClusterTree& clusters;
      Meet& meet;
      bool QueryCallback(int32 proxy) {
        meet(clusters.cluster_of_proxy_[static_cast<std::size_t>(proxy)]);
        return true;
      }
    } callback{*this, meet};
    tree_.Query(&callback, box);
  }

 private:
  b2DynamicTree tree_;
  std::vector<int> proxies_;  // by cluster
  std::vector<int> cluster_of_proxy_;
};

/// work(range, from, to) for each range's share [from, to) of so many clusters.
template <class Work>
void share_clusters(const Ranges& ranges, std::size_t clusters, Work work) {
  const std::size_t count = static_cast<std::size_t>(ranges.count);
  ranges.for_each([&](int range) {
    const std::size_t k = static_cast<std::size_t>(range);
    work(range, clusters * k / count, clusters * (k + 1) / count);
  });
}

/// Fills `walls` with the numbers of those that have a fixture which meets `box`, in order: a fixture's user data is
/// its wall's number.
void walls_in(const b2World& world, const b2AABB& box, std::vector<int>& walls);

/// What the ranges found, sorted by grain and wall.
template <class Part>
void join_walls(const std::vector<Part>& parts, std::vector<WallCandidate>& near_walls) {
  near_walls.clear();
  for (const Part& part : parts) near_walls.insert(near_walls.end(), part.walls.begin(), part.walls.end());
  std::ranges::sort(near_walls, [](const WallCandidate& a, const WallCandidate& b) {
    return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
  });
}

}  // namespace vibrosow
