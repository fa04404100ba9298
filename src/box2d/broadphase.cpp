#include "box2d/broadphase.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "scene/vessel_walls.hpp"

namespace vibrosow {

namespace {

constexpr std::size_t cluster_size = 8;  // grains
constexpr double strip_height = 2.8;     // in diameters of the largest grain: eight of them fill about a square

/// Grains in the order of their places, so that each eight that follow each other are neighbours.
struct Sorted {
  std::vector<int> grain;         // by place
  std::vector<double> x, y, r;    // m, relative to the first vessel
  std::vector<int> strip, count;  // by grain; by strip

  std::size_t clusters() const { return (grain.size() + cluster_size - 1) / cluster_size; }
  std::size_t begin(std::size_t cluster) const { return cluster * cluster_size; }
  std::size_t end(std::size_t cluster) const { return std::min(begin(cluster + 1), grain.size()); }

  /// Strip by strip from below, each from left to right.
  void sort(const Grains& grains, const Eigen::Vector2d& shift, double height) {
    const std::size_t n = grains.size();
    grain.resize(n), x.resize(n), y.resize(n), r.resize(n), strip.resize(n);
    if (n == 0) return;
    const auto [low, high] = std::minmax_element(grains.y.begin(), grains.y.end());
    // A grain thrown far off must not cost a strip for every diameter on its way.
    const double bottom = *low, step = std::max(height, (*high - *low) / static_cast<double>(n));
    count.assign(static_cast<std::size_t>((*high - *low) / step) + 2, 0);
    for (std::size_t i = 0; i < n; ++i) {
      strip[i] = static_cast<int>((grains.y[i] - bottom) / step);
      ++count[static_cast<std::size_t>(strip[i]) + 1];
    }
    std::partial_sum(count.begin(), count.end(), count.begin());
    for (std::size_t i = 0; i < n; ++i)
      grain[static_cast<std::size_t>(count[static_cast<std::size_t>(strip[i])]++)] = static_cast<int>(i);
    for (std::size_t k = 0, from = 0; k + 1 < count.size(); from = static_cast<std::size_t>(count[k++]))
      std::sort(grain.begin() + static_cast<std::ptrdiff_t>(from), grain.begin() + count[k], [&](int a, int b) {
        return grains.x[static_cast<std::size_t>(a)] < grains.x[static_cast<std::size_t>(b)];
      });
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(grain[k]);
      x[k] = grains.x[i] - shift.x(), y[k] = grains.y[i] - shift.y(), r[k] = grains.kind(i).radius;
    }
  }
};

}  // namespace

struct Broadphase::World {
  b2World world{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies;                    // by vessel
  std::vector<b2Vec2> rest;                       // by vessel, where its body stands at rest
  std::vector<double> tilt;                       // by vessel, rad
  std::vector<std::vector<b2Fixture*>> fixtures;  // by wall; an arc is several edges
  double largest_sagitta = 0;                     // m, by which an arc bulges beyond its edges
  Sorted sorted;
  b2DynamicTree tree;        // of the clusters
  std::vector<int> proxies;  // by cluster
  std::vector<int> cluster_of_proxy;
  std::vector<int> found;  // clusters, or walls
  PairList unsorted;
  std::size_t expected_pairs = 0;
  std::vector<int> row_end;  // by grain
  double units_per_metre;

  explicit World(double unit) : units_per_metre(1 / unit) {}

  b2Vec2 units(const Eigen::Vector2d& metres) const {
    return {static_cast<float>(metres.x() * units_per_metre), static_cast<float>(metres.y() * units_per_metre)};
  }

  /// Holds a cluster's grains, widened by `margin` and moved by `moved` along x (m).
  b2AABB box(std::size_t cluster, double margin, double moved = 0) const {
    const std::size_t first = sorted.begin(cluster);
    double left = sorted.x[first], right = left, low = sorted.y[first], high = low, largest = 0;
    for (std::size_t k = first; k < sorted.end(cluster); ++k) {
      left = std::min(left, sorted.x[k]), right = std::max(right, sorted.x[k]);
      low = std::min(low, sorted.y[k]), high = std::max(high, sorted.y[k]);
      largest = std::max(largest, sorted.r[k]);
    }
    const double u = units_per_metre, far = std::max({-left, right, -low, high, std::abs(moved)});
    // Rounding to float must never shrink a box.
    const double wider = (margin + largest) * u + 1e-6 * (1 + 2 * far * u);
    b2AABB box;
    box.lowerBound.Set(static_cast<float>((left + moved) * u - wider), static_cast<float>(low * u - wider));
    box.upperBound.Set(static_cast<float>((right + moved) * u + wider), static_cast<float>(high * u + wider));
    return box;
  }

  /// Box2D's frame is displaced with the first vessel, which turns in it; the others move past it.
  void place_vessels(const std::vector<Pose>& poses) {
    for (std::size_t v = 0; v < bodies.size(); ++v) {
      const b2Vec2 position = rest[v] + units(poses[v].displacement - poses.front().displacement);
      const float angle = static_cast<float>(tilt[v] + poses[v].angle);
      if (bodies[v]->GetPosition() != position || bodies[v]->GetAngle() != angle)
        bodies[v]->SetTransform(position, angle);
    }
  }

  /// Forms the clusters afresh and brings the tree up to date with them.
  void update_boxes(const Grains& grains, const Eigen::Vector2d& shift) {
    sorted.sort(grains, shift, strip_height / units_per_metre);
    while (proxies.size() > sorted.clusters()) tree.DestroyProxy(proxies.back()), proxies.pop_back();
    for (std::size_t c = 0; c < sorted.clusters(); ++c) {
      if (c < proxies.size())
        tree.MoveProxy(proxies[c], box(c, 0), b2Vec2(0, 0));
      else
        proxies.push_back(tree.CreateProxy(box(c, 0), nullptr));
      const std::size_t proxy = static_cast<std::size_t>(proxies[c]);
      if (cluster_of_proxy.size() <= proxy) cluster_of_proxy.resize(proxy + 1);
      cluster_of_proxy[proxy] = static_cast<int>(c);
    }
  }

  /// Box2D's tree calls it for every cluster met.
  bool QueryCallback(int32 proxy) {
    found.push_back(cluster_of_proxy[static_cast<std::size_t>(proxy)]);
    return true;
  }

  /// Adds the pairs of grain `k` by place, moved by `moved` along x (m), and those of places [from, to) near enough.
  void add_near(std::size_t k, double moved, double margin, std::size_t from, std::size_t to) {
    const double x = sorted.x[k] + moved, y = sorted.y[k], reach = sorted.r[k] + margin;
    std::array<int, cluster_size + 1> near;
    std::size_t count = 0;
    for (std::size_t m = from; m < to; ++m) {
      const double dx = sorted.x[m] - x, dy = sorted.y[m] - y, limit = reach + sorted.r[m];
      near[count] = sorted.grain[m];
      count += dx * dx + dy * dy < limit * limit ? 1 : 0;  // without a branch: a third are
    }
    for (std::size_t m = 0; m < count; ++m) unsorted.add(sorted.grain[k], near[m]);
  }

  /// All that was added, by grain and then by partner.
  void sort_pairs(std::size_t grains, PairList& pairs) {
    row_end.assign(grains + 1, 0);
    for (const int i : unsorted.grain) ++row_end[static_cast<std::size_t>(i) + 1];
    std::partial_sum(row_end.begin(), row_end.end(), row_end.begin());
    pairs.grain.resize(unsorted.size()), pairs.partner.resize(unsorted.size());
    for (std::size_t k = 0; k < unsorted.size(); ++k) {
      const std::size_t place = static_cast<std::size_t>(row_end[static_cast<std::size_t>(unsorted.grain[k])]++);
      pairs.grain[place] = unsorted.grain[k], pairs.partner[place] = unsorted.partner[k];
    }
    for (std::size_t i = 0, from = 0; i < grains; from = static_cast<std::size_t>(row_end[i++]))
      std::sort(pairs.partner.begin() + static_cast<std::ptrdiff_t>(from), pairs.partner.begin() + row_end[i]);
    const std::size_t about = unsorted.size() + unsorted.size() / 8;
    unsorted = {};  // seldom needed, and as large as all else together
    expected_pairs = about;
  }
};

namespace {

/// The corners of a wall as a chain of straight edges, none further than 0.05 of a unit (m) from the wall;
/// `largest_sagitta` is raised to how far.
std::vector<Eigen::Vector2d> edges_of(const WallSegment& wall, double unit, double& largest_sagitta) {
  if (wall.radius == 0) return {wall.a, wall.b};
  const double allowed = std::min(0.05 * unit, wall.radius), span = wall.to - wall.from;
  const int edges = std::max(1, static_cast<int>(std::ceil(span / (2 * std::acos(1 - allowed / wall.radius)))));
  largest_sagitta = std::max(largest_sagitta, wall.radius * (1 - std::cos(0.5 * span / edges)));
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k <= edges; ++k) {
    const double angle = wall.from + span * k / edges;
    corners.push_back(wall.centre + wall.radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

struct WallQuery : b2QueryCallback {
  explicit WallQuery(std::vector<int>& walls) : found(walls) {}
  bool ReportFixture(b2Fixture* fixture) override {
    found.push_back(static_cast<int>(fixture->GetUserData().pointer));
    return true;
  }
  std::vector<int>& found;
};

}  // namespace

Broadphase::Broadphase(const std::vector<Vessel>& vessels, double unit) : world_(std::make_unique<World>(unit)) {
  World& w = *world_;
  for (const Vessel& vessel : vessels) {
    b2BodyDef definition;
    definition.type = w.bodies.empty() ? b2_kinematicBody : b2_staticBody;
    definition.position = w.units(vessel.origin);
    definition.angle = static_cast<float>(vessel.tilt);
    b2Body* body = w.world.CreateBody(&definition);
    w.bodies.push_back(body);
    w.rest.push_back(definition.position);
    w.tilt.push_back(vessel.tilt);
    for (const WallSegment& wall : vessel_walls(vessel)) {
      const std::vector<Eigen::Vector2d> corners = edges_of(wall, unit, w.largest_sagitta);
      std::vector<b2Fixture*> fixtures;
      for (std::size_t k = 1; k < corners.size(); ++k) {
        b2EdgeShape edge;  // a chain would be one-sided
        edge.SetTwoSided(w.units(corners[k - 1]), w.units(corners[k]));
        b2FixtureDef fixture;
        fixture.shape = &edge;
        fixture.userData.pointer = w.fixtures.size();
        fixtures.push_back(body->CreateFixture(&fixture));
      }
      w.fixtures.push_back(std::move(fixtures));
    }
  }
}

Broadphase::~Broadphase() = default;

std::size_t Broadphase::wall_count() const {
  return world_->fixtures.size();
}

void Broadphase::remove_wall(int wall) {
  std::vector<b2Fixture*>& fixtures = world_->fixtures[static_cast<std::size_t>(wall)];
  for (b2Fixture* fixture : fixtures) fixture->GetBody()->DestroyFixture(fixture);
  fixtures.clear();
}

void Broadphase::find(const Grains& grains, const std::vector<Pose>& poses, double margin, PairList& pairs,
                      std::vector<WallCandidate>& near_walls) {
  World& w = *world_;
  w.place_vessels(poses);
  w.update_boxes(grains, poses.front().displacement);

  near_walls.clear();
  w.unsorted.grain.reserve(w.expected_pairs), w.unsorted.partner.reserve(w.expected_pairs);
  for (std::size_t c = 0; c < w.sorted.clusters(); ++c) {
    const std::size_t first = w.sorted.begin(c), last = w.sorted.end(c);
    w.found.clear();
    w.tree.Query(&w, w.box(c, margin));
    for (const int d : w.found) {
      const std::size_t other = static_cast<std::size_t>(d);
      if (other > c) continue;
      for (std::size_t k = first; k < last; ++k)
        w.add_near(k, 0, margin, w.sorted.begin(other), other == c ? k : w.sorted.end(other));
    }

    w.found.clear();
    WallQuery walls(w.found);
    w.world.QueryAABB(&walls, w.box(c, margin + w.largest_sagitta));
    std::sort(w.found.begin(), w.found.end());
    w.found.erase(std::unique(w.found.begin(), w.found.end()), w.found.end());
    for (std::size_t k = first; k < last; ++k)
      for (const int wall : w.found) near_walls.push_back({w.sorted.grain[k], wall, 0.0});
  }
  for (std::size_t k = 0; k < w.unsorted.size(); ++k)
    if (w.unsorted.grain[k] < w.unsorted.partner[k]) std::swap(w.unsorted.grain[k], w.unsorted.partner[k]);
  w.sort_pairs(grains.size(), pairs);
  std::sort(near_walls.begin(), near_walls.end(), [](const WallCandidate& a, const WallCandidate& b) {
    return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
  });
}

void Broadphase::find_across(const Grains& grains, double period, double margin, PairList& pairs) {
  World& w = *world_;
  for (std::size_t c = 0; c < w.sorted.clusters(); ++c) {
    w.found.clear();
    w.tree.Query(&w, w.box(c, margin, period));
    for (const int d : w.found)
      for (std::size_t k = w.sorted.begin(c); k < w.sorted.end(c); ++k)
        w.add_near(k, period, margin, w.sorted.begin(static_cast<std::size_t>(d)),
                   w.sorted.end(static_cast<std::size_t>(d)));
  }
  w.sort_pairs(grains.size(), pairs);
}

}  // namespace vibrosow
