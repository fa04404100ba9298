#include "box2d/broadphase.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "box2d/cluster_search.hpp"
#include "box2d/near_places.hpp"
#include "box2d/pair_rows.hpp"
#include "portable_math/functions.hpp"
#include "vessel/directions.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

namespace {

constexpr double strip_height = 2.8;  // in diameters of the largest grain: eight of them fill about a square

/// Places of the grains of some clusters, next to each other in memory.
struct Surroundings {
  std::vector<int> grain;
  std::vector<double> x, y, r;  // m

  void clear() { grain.clear(), x.clear(), y.clear(), r.clear(); }
  Places view() const { return {static_cast<int>(grain.size()), grain.data(), x.data(), y.data(), r.data()}; }
};

/// Grains in the order of their places, so that each eight that follow each other are neighbours.
struct Sorted {
  std::vector<int> grain;         // by place
  std::vector<double> x, y;       // m, relative to the first vessel
  std::vector<double> r, wall_r;  // m, reaches
  std::vector<int> strip, count;  // by grain; by strip

  std::size_t clusters() const { return (grain.size() + cluster_size - 1) / cluster_size; }
  std::size_t begin(std::size_t cluster) const { return cluster * cluster_size; }
  std::size_t end(std::size_t cluster) const { return std::min(begin(cluster + 1), grain.size()); }

  /// Strip by strip from below, each from left to right.
  void sort(const Grains& grains, const Reaches& reaches, const Eigen::Vector2d& shift, double height) {
    const std::size_t n = grains.size();
    grain.resize(n), x.resize(n), y.resize(n), r.resize(n), wall_r.resize(n), strip.resize(n);
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
      x[k] = grains.x[i] - shift.x(), y[k] = grains.y[i] - shift.y();
      r[k] = reaches.pair[i], wall_r[k] = reaches.wall[i];
    }
  }
};

/// What one range of a search works with and finds.
struct Part {
  std::vector<int> found;  // clusters, or walls
  Surroundings around;
  std::vector<WallCandidate> walls;
};

}  // namespace

struct Broadphase::World {
  struct Wall {
    b2Body* body;
    std::vector<Eigen::Vector2d> corners;  // m, in the vessel's frame; an arc is several edges
    std::vector<b2Fixture*> fixtures;      // none while the wall is removed
  };

  b2World world{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies;  // by vessel
  std::vector<b2Vec2> rest;     // by vessel, where its body stands at rest
  std::vector<double> tilt;     // by vessel, rad
  std::vector<Wall> walls;
  double largest_sagitta = 0;  // m, by which an arc bulges beyond its edges
  Sorted sorted;
  ClusterTree tree;
  std::vector<Part> parts;  // by range
  PairRows rows;
  double units_per_metre;
  NearPlaces near_places;

  World(double unit, InstructionSet instructions)
      : units_per_metre(1 / unit), near_places(vibrosow::near_places(instructions)) {}

  b2Vec2 units(const Eigen::Vector2d& metres) const {
    return {static_cast<float>(metres.x() * units_per_metre), static_cast<float>(metres.y() * units_per_metre)};
  }

  void create_fixtures(std::size_t number) {
    Wall& wall = walls[number];
    for (std::size_t k = 1; k < wall.corners.size(); ++k) {
      b2EdgeShape edge;  // a chain would be one-sided
      edge.SetTwoSided(units(wall.corners[k - 1]), units(wall.corners[k]));
      b2FixtureDef fixture;
      fixture.shape = &edge;
      fixture.userData.pointer = number;
      wall.fixtures.push_back(wall.body->CreateFixture(&fixture));
    }
  }

  /// Holds a cluster's grains, widened by the largest of their `reaches` and `margin` and moved by `moved` along x (m).
  b2AABB box(std::size_t cluster, const std::vector<double>& reaches, double margin, double moved = 0) const {
    const std::size_t first = sorted.begin(cluster);
    double left = sorted.x[first], right = left, low = sorted.y[first], high = low, largest = 0;
    for (std::size_t k = first; k < sorted.end(cluster); ++k) {
      left = std::min(left, sorted.x[k]), right = std::max(right, sorted.x[k]);
      low = std::min(low, sorted.y[k]), high = std::max(high, sorted.y[k]);
      largest = std::max(largest, reaches[k]);
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
      // Within a turn, whose float is precise enough however often the vessel has turned.
      const float angle = static_cast<float>(std::remainder(tilt[v] + poses[v].angle, 2 * std::numbers::pi));
      if (bodies[v]->GetPosition() != position || bodies[v]->GetAngle() != angle)
        bodies[v]->SetTransform(position, angle);
    }
  }

  /// Forms the clusters afresh and brings the tree up to date with them.
  void update_boxes(const Grains& grains, const Reaches& reaches, const Eigen::Vector2d& shift) {
    sorted.sort(grains, reaches, shift, strip_height / units_per_metre);
    tree.update(sorted.clusters(), [&](std::size_t c) { return box(c, sorted.r, 0); });
  }

  /// For each grain of the clusters [from, to), moved by `moved` along x (m): the numbers of those that are nearer than
  /// r + r + margin (m) to it, where `all` is not set only of those with higher numbers than its own.
  void look_around(int range, std::size_t from, std::size_t to, double margin, double moved, bool all) {
    Part& part = parts[static_cast<std::size_t>(range)];
    rows.begin_range(range);
    for (std::size_t c = from; c < to; ++c) {
      part.found.clear();
      tree.query(box(c, sorted.r, margin, moved), [&](int met) { part.found.push_back(met); });
      gather(part.found, part.around);
      for (std::size_t k = sorted.begin(c); k < sorted.end(c); ++k) {
        const int grain = sorted.grain[k];
        int* near = rows.room(range, part.around.grain.size() + 16);
        const int count = near_places(part.around.view(), all ? -1 : grain, sorted.x[k] + moved, sorted.y[k],
                                      sorted.r[k] + margin, near);
        rows.found(range, grain, count);
      }
    }
  }

  void gather(const std::vector<int>& clusters, Surroundings& around) const {
    around.clear();
    for (const int c : clusters) {
      const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(sorted.begin(static_cast<std::size_t>(c)));
      const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(sorted.end(static_cast<std::size_t>(c)));
      const auto append = [from, to](auto& array, const auto& all) {
        array.insert(array.end(), all.begin() + from, all.begin() + to);
      };
      append(around.grain, sorted.grain);
      append(around.x, sorted.x), append(around.y, sorted.y), append(around.r, sorted.r);
    }
    // Whole vectors of the widest kind: what is added has no number that any grain looks for.
    const std::size_t padded = (around.grain.size() + 63) / 64 * 64;
    around.grain.resize(padded, -1);
    for (std::vector<double>* array : {&around.x, &around.y, &around.r}) array->resize(padded, 0.0);
  }

  /// All walls that a box of one of the clusters [from, to) meets, for each of the cluster's grains.
  void look_for_walls(Part& part, std::size_t from, std::size_t to, double margin) const {
    part.walls.clear();
    for (std::size_t c = from; c < to; ++c) {
      walls_in(world, box(c, sorted.wall_r, margin + largest_sagitta), part.found);
      for (std::size_t k = sorted.begin(c); k < sorted.end(c); ++k)
        for (const int wall : part.found) part.walls.push_back({sorted.grain[k], wall, 0.0});
    }
  }

  void find_pairs(const Ranges& ranges, double margin, double moved, bool all, PairList& pairs) {
    parts.resize(static_cast<std::size_t>(ranges.count));
    rows.begin(sorted.grain.size(), ranges.count);
    share_clusters(ranges, sorted.clusters(), [&](int range, std::size_t from, std::size_t to) {
      look_around(range, from, to, margin, moved, all);
    });
    rows.transpose(pairs);
  }
};

namespace {

/// The corners of a wall as a chain of straight edges, none further than 0.05 of a unit (m) from the wall;
/// `largest_sagitta` is raised to how far.
std::vector<Eigen::Vector2d> edges_of(const WallSegment& wall, double unit, double& largest_sagitta) {
  if (wall.radius == 0) return {wall.a, wall.b};
  const double allowed = std::min(0.05 * unit, wall.radius), span = wall.to - wall.from;
  const int edges =
      std::max(1, static_cast<int>(std::ceil(span / (2 * portable_math::acos(1 - allowed / wall.radius)))));
  largest_sagitta = std::max(largest_sagitta, wall.radius * (1 - portable_math::cos(0.5 * span / edges)));
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k <= edges; ++k) {
    const double angle = wall.from + span * k / edges;
    corners.push_back(wall.centre + wall.radius * unit_vector(angle));
  }
  return corners;
}

}  // namespace

Reaches reaches_at_rest(const Grains& grains) {
  Reaches reaches;
  for (std::size_t i = 0; i < grains.size(); ++i) reaches.pair.push_back(grains.kind(i).radius);
  reaches.wall = reaches.pair;
  return reaches;
}

Broadphase::Broadphase(const std::vector<Vessel>& vessels, double unit, InstructionSet instructions)
    : world_(std::make_unique<World>(unit, instructions)) {
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
      w.walls.push_back({body, edges_of(wall, unit, w.largest_sagitta), {}});
      w.create_fixtures(w.walls.size() - 1);
    }
  }
}

Broadphase::~Broadphase() = default;

void Broadphase::remove_wall(int wall) {
  std::vector<b2Fixture*>& fixtures = world_->walls[static_cast<std::size_t>(wall)].fixtures;
  for (b2Fixture* fixture : fixtures) fixture->GetBody()->DestroyFixture(fixture);
  fixtures.clear();
}

void Broadphase::restore_wall(int wall) {
  world_->create_fixtures(static_cast<std::size_t>(wall));
}

void Broadphase::find(const Grains& grains, const std::vector<Pose>& poses, const Reaches& reaches, double margin,
                      const Ranges& ranges, PairList& pairs, std::vector<WallCandidate>& near_walls) {
  World& w = *world_;
  w.place_vessels(poses);
  w.update_boxes(grains, reaches, poses.front().displacement);
  w.find_pairs(ranges, margin, 0, false, pairs);

  share_clusters(ranges, w.sorted.clusters(), [&](int range, std::size_t from, std::size_t to) {
    w.look_for_walls(w.parts[static_cast<std::size_t>(range)], from, to, margin);
  });
  join_walls(w.parts, near_walls);
}

void Broadphase::find_across(double period, double margin, const Ranges& ranges, PairList& pairs) {
  world_->find_pairs(ranges, margin, -period, true, pairs);
}

}  // namespace vibrosow
