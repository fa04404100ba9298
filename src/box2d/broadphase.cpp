#include "box2d/broadphase.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/vessel_walls.hpp"

namespace vibrosow {

struct Broadphase::World {
  b2World world{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies;                    // by vessel
  std::vector<b2Vec2> rest;                       // by vessel, where its body stands at rest
  std::vector<double> tilt;                       // by vessel, rad
  std::vector<std::vector<b2Fixture*>> fixtures;  // by wall; an arc is several edges
  double largest_sagitta = 0;                     // m, by which an arc bulges beyond its edges
  b2DynamicTree tree;                             // of the grains
  std::vector<int> proxies;                       // by grain
  std::vector<std::int64_t> numbers;              // by grain, ascending: which grain a proxy stands for
  std::vector<int> grain_of_proxy;                // by proxy
  std::vector<int> found;
  double units_per_metre;

  explicit World(double unit) : units_per_metre(1 / unit) {}

  b2Vec2 units(const Eigen::Vector2d& metres) const {
    return {static_cast<float>(metres.x() * units_per_metre), static_cast<float>(metres.y() * units_per_metre)};
  }

  b2AABB box(double x, double y, double half) const {
    const double cx = x * units_per_metre, cy = y * units_per_metre;
    // Rounding to float must never shrink a box.
    const double h = half * units_per_metre + 1e-6 * (1 + std::abs(cx) + std::abs(cy));
    b2AABB box;
    box.lowerBound.Set(static_cast<float>(cx - h), static_cast<float>(cy - h));
    box.upperBound.Set(static_cast<float>(cx + h), static_cast<float>(cy + h));
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

  /// Brings the tree up to date with the grains: grains gone, moved out of their boxes, or new.
  void update_boxes(const Grains& grains, const Eigen::Vector2d& shift) {
    std::size_t kept = 0;
    for (std::size_t old = 0; old < proxies.size(); ++old) {
      if (kept < grains.size() && grains.number[kept] == numbers[old])
        proxies[kept++] = proxies[old];
      else
        tree.DestroyProxy(proxies[old]);
    }
    proxies.resize(grains.size());
    numbers.assign(grains.number.begin(), grains.number.end());
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const b2AABB tight = box(grains.x[i] - shift.x(), grains.y[i] - shift.y(), grains.kind(i).radius);
      if (i < kept)
        tree.MoveProxy(proxies[i], tight, b2Vec2(0, 0));
      else
        proxies[i] = tree.CreateProxy(tight, nullptr);
      const std::size_t proxy = static_cast<std::size_t>(proxies[i]);
      if (grain_of_proxy.size() <= proxy) grain_of_proxy.resize(proxy + 1);
      grain_of_proxy[proxy] = static_cast<int>(i);
    }
  }
};

namespace {

/// Collects the grains after `i` that are near enough; Box2D's tree calls it for every box met.
struct PairQuery {
  const std::vector<int>& grain_of_proxy;
  const Grains& grains;
  std::size_t i;
  double reach;  // m, r_i + margin
  std::vector<int>& found;

  bool QueryCallback(int32 proxy) {
    const std::size_t j = static_cast<std::size_t>(grain_of_proxy[static_cast<std::size_t>(proxy)]);
    if (j <= i) return true;
    const double dx = grains.x[j] - grains.x[i], dy = grains.y[j] - grains.y[i];
    const double limit = reach + grains.kind(j).radius;
    if (dx * dx + dy * dy < limit * limit) found.push_back(static_cast<int>(j));
    return true;
  }
};

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

/// The same across a seam: for all grains near the place of grain `i` a period to the right.
struct SeamQuery {
  const std::vector<int>& grain_of_proxy;
  const Grains& grains;
  double x, y, reach;  // m
  std::vector<int>& found;

  bool QueryCallback(int32 proxy) {
    const std::size_t j = static_cast<std::size_t>(grain_of_proxy[static_cast<std::size_t>(proxy)]);
    const double dx = grains.x[j] - x, dy = grains.y[j] - y;
    const double limit = reach + grains.kind(j).radius;
    if (dx * dx + dy * dy < limit * limit) found.push_back(static_cast<int>(j));
    return true;
  }
};

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
  const Eigen::Vector2d shift = poses.front().displacement;
  w.place_vessels(poses);
  w.update_boxes(grains, shift);

  pairs.first.assign(1, 0);
  pairs.partner.clear();
  near_walls.clear();
  WallQuery walls(w.found);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double reach = grains.kind(i).radius + margin;
    const b2AABB box = w.box(grains.x[i] - shift.x(), grains.y[i] - shift.y(), reach);
    w.found.clear();
    PairQuery query{w.grain_of_proxy, grains, i, reach, w.found};
    w.tree.Query(&query, box);
    std::sort(w.found.begin(), w.found.end());
    pairs.partner.insert(pairs.partner.end(), w.found.begin(), w.found.end());
    pairs.first.push_back(static_cast<int>(pairs.partner.size()));

    w.found.clear();
    w.world.QueryAABB(&walls, w.box(grains.x[i] - shift.x(), grains.y[i] - shift.y(), reach + w.largest_sagitta));
    std::sort(w.found.begin(), w.found.end());
    w.found.erase(std::unique(w.found.begin(), w.found.end()), w.found.end());
    for (int wall : w.found) near_walls.push_back({static_cast<int>(i), wall, 0.0});
  }
}

void Broadphase::find_across(const Grains& grains, const std::vector<Pose>& poses, double period, double margin,
                             PairList& pairs) {
  World& w = *world_;
  const Eigen::Vector2d shift = poses.front().displacement;
  pairs.first.assign(1, 0);
  pairs.partner.clear();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double x = grains.x[i] + period, y = grains.y[i], reach = grains.kind(i).radius + margin;
    w.found.clear();
    SeamQuery query{w.grain_of_proxy, grains, x, y, reach, w.found};
    w.tree.Query(&query, w.box(x - shift.x(), y - shift.y(), reach));
    std::sort(w.found.begin(), w.found.end());
    pairs.partner.insert(pairs.partner.end(), w.found.begin(), w.found.end());
    pairs.first.push_back(static_cast<int>(pairs.partner.size()));
  }
}

}  // namespace vibrosow
