#include "box2d/broadphase_3d.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "box2d/cluster_search.hpp"
#include "box2d/near_places.hpp"
#include "box2d/pair_rows.hpp"
#include "scene/motion.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

constexpr std::size_t widest = 64;     // numbers in a vector of the widest kind
constexpr double slab_diameters = 2;   // of the largest ball: eight of them fill about a cube
constexpr double strip_diameters = 2;  // within a slab

/// A box with sides along the axes, m.
struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;

  void include(const Eigen::Vector3d& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
};

/// Neighbouring balls: places [begin, end) of the sorted ones.
struct Cluster {
  std::size_t begin, end;
  int slab;
  Box box;                           // of centres
  double largest, largest_to_walls;  // m, reach
};

/// Balls in the order of their places: slab by slab from below, strip by strip across, to and fro along.
struct SortedBalls {
  std::vector<int> grain;       // by place
  std::vector<double> x, y, z;  // m, relative to the first vessel
  std::vector<double> r;        // m, reach for pairs
  std::vector<Cluster> clusters;
  double bottom = 0, slab_height = 1;  // m
  double largest = 0;                  // m, reach for pairs
  int slabs = 0;

  void sort(const Grains& grains, const Reaches& reaches, const Eigen::Vector3d& shift, double diameter) {
    const std::size_t n = grains.size();
    grain.resize(n), x.resize(n), y.resize(n), z.resize(n), r.resize(n);
    clusters.clear(), slabs = 0, largest = 0;
    if (n == 0) return;
    const auto [low, high] = std::ranges::minmax(grains.y);
    // A ball thrown far off must not cost a slab for every diameter on its way.
    slab_height = std::max(slab_diameters * diameter, (high - low) / static_cast<double>(n));
    bottom = low - shift.y();
    const double near = std::ranges::min(grains.z), strip = strip_diameters * diameter;
    struct Key {
      int slab, strip;
      double along;
    };
    std::vector<Key> keys(n);
    for (std::size_t i = 0; i < n; ++i) {
      Key& key = keys[i];
      key.slab = static_cast<int>((grains.y[i] - low) / slab_height);
      key.strip = static_cast<int>(std::min((grains.z[i] - near) / strip, 1e6));
      if (key.slab % 2 == 1) key.strip = -key.strip;  // the next slab begins where this one ends
      key.along = key.strip % 2 == 0 ? grains.x[i] : -grains.x[i];
      slabs = std::max(slabs, key.slab + 1);
    }
    std::iota(grain.begin(), grain.end(), 0);
    std::ranges::sort(grain, [&keys](int a, int b) {
      const Key &p = keys[static_cast<std::size_t>(a)], &q = keys[static_cast<std::size_t>(b)];
      if (p.slab != q.slab) return p.slab < q.slab;
      if (p.strip != q.strip) return p.strip < q.strip;
      return p.along != q.along ? p.along < q.along : a < b;
    });
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(grain[k]);
      x[k] = grains.x[i] - shift.x(), y[k] = grains.y[i] - shift.y(), z[k] = grains.z[i] - shift.z();
      r[k] = reaches.pair[i];
      const int slab = keys[i].slab;
      if (clusters.empty() || clusters.back().slab != slab ||
          clusters.back().end - clusters.back().begin == cluster_size)
        clusters.push_back({k, k, slab, {}, 0, 0});
      Cluster& cluster = clusters.back();
      cluster.end = k + 1;
      cluster.box.include({x[k], y[k], z[k]});
      cluster.largest = std::max(cluster.largest, r[k]);
      cluster.largest_to_walls = std::max(cluster.largest_to_walls, reaches.wall[i]);
      largest = std::max(largest, r[k]);
    }
  }

  int slab_at(double height) const { return static_cast<int>(std::floor((height - bottom) / slab_height)); }
};

/// Balls of some clusters, next to each other in memory.
struct Around {
  std::vector<int> grain;
  std::vector<double> x, y, z, r;  // m

  void resize(std::size_t n) { grain.resize(n), x.resize(n), y.resize(n), z.resize(n), r.resize(n); }
  /// Its plan is x and z.
  Places view() const { return {static_cast<int>(grain.size()), grain.data(), x.data(), z.data(), r.data()}; }
};

struct Part {
  std::vector<int> found;  // clusters, or walls
  Around around;
  std::vector<WallCandidate> walls;
};

/// Holds a face of a vessel as it is turned, in the lab's directions about the vessel's zero.
Box box_of(const Face& face, const Vessel& vessel, const Pose& pose) {
  Box box;
  const auto include = [&](const Eigen::Vector3d& point) { box.include(direction_in_lab(vessel, pose, point)); };
  if (face.kind == Face::Kind::plate) {
    for (const double u : {0.0, face.length_u})
      for (const double v : {0.0, face.length_v}) include(face.origin + u * face.e1 + v * face.e2);
    return box;
  }
  for (const auto& [radius, height] :
       {std::pair(face.radius_a, face.height_a), std::pair(face.radius_b, face.height_b)})
    for (const double u : {-radius, radius})
      for (const double v : {-radius, radius}) include(face.origin + u * face.e1 + v * face.e2 + height * face.normal);
  return box;
}

}  // namespace

struct Broadphase3d::World {
  struct Wall {
    b2Body* body;
    std::size_t vessel;
    Face own;
    Box box{};  // m, about the vessel's zero
    b2Fixture* fixture = nullptr;
  };
  b2World world{b2Vec2(0, 0)};
  std::vector<Vessel> vessels;
  std::vector<b2Body*> bodies;        // by vessel
  std::vector<Eigen::Vector2d> rest;  // m, by vessel, its zero in the plan
  std::vector<double> height;         // m, by vessel, its zero
  std::vector<Wall> walls;
  std::vector<Pose> poses;
  SortedBalls sorted;
  ClusterTree tree;
  double stride = 0;        // m, along x from a slab's plan to the next
  std::vector<Part> parts;  // by range
  PairRows rows;
  double diameter, units_per_metre;
  NearPlaces3d near_places;

  World(double unit, InstructionSet instructions)
      : diameter(unit), units_per_metre(1 / unit), near_places(near_places_3d(instructions)) {}

  /// In the plan, widened by `wider` (m) and moved by `moved` along x; rounding to float must never shrink it.
  b2AABB in_plan(const Box& box, double wider, double moved) const {
    const double u = units_per_metre;
    const double far = std::max({std::abs(box.low.x() + moved), std::abs(box.high.x() + moved), std::abs(box.low.z()),
                                 std::abs(box.high.z()), std::abs(moved)});
    const double margin = wider * u + 1e-6 * (1 + 2 * far * u);
    b2AABB plan;
    plan.lowerBound.Set(static_cast<float>((box.low.x() + moved) * u - margin),
                        static_cast<float>(box.low.z() * u - margin));
    plan.upperBound.Set(static_cast<float>((box.high.x() + moved) * u + margin),
                        static_cast<float>(box.high.z() * u + margin));
    return plan;
  }

  void create_fixture(std::size_t number) {
    Wall& wall = walls[number];
    const b2AABB plan = in_plan(wall.box, 0, 0);
    b2PolygonShape shape;  // a rectangle, or what Box2D takes for one where the face is upright
    const b2Vec2 half = plan.GetExtents();
    shape.SetAsBox(std::max(half.x, 1e-3f), std::max(half.y, 1e-3f), plan.GetCenter(), 0);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.userData.pointer = number;
    wall.fixture = wall.body->CreateFixture(&fixture);
  }

  /// Where a vessel's zero stands in Box2D's frame, which is displaced with the first vessel.
  Eigen::Vector3d zero_of(std::size_t v) const {
    const Eigen::Vector2d moved = poses[v].displacement - poses.front().displacement;
    return {rest[v].x() + moved.x(), height[v] + moved.y(), rest[v].y() + poses[v].across - poses.front().across};
  }

  /// Box2D's bodies turn in the plan alone, so faces that turn get new shapes.
  void turn_walls() {
    for (std::size_t number = 0; number < walls.size(); ++number) {
      Wall& wall = walls[number];
      const std::optional<VesselMotion>& motion = vessels[wall.vessel].motion;
      if (!wall.fixture || !motion || !turns(*motion)) continue;
      wall.body->DestroyFixture(wall.fixture);
      wall.box = box_of(wall.own, vessels[wall.vessel], poses[wall.vessel]);
      create_fixture(number);
    }
  }

  void place_vessels() {
    for (std::size_t v = 0; v < bodies.size(); ++v) {
      const Eigen::Vector3d zero = units_per_metre * zero_of(v);
      const b2Vec2 position(static_cast<float>(zero.x()), static_cast<float>(zero.z()));
      if (bodies[v]->GetPosition() != position) bodies[v]->SetTransform(position, 0);
    }
  }

  /// Forms the clusters afresh and brings the tree up to date with them.
  void update_boxes(const Grains& grains, const Reaches& reaches, double margin) {
    const Eigen::Vector2d& moved = poses.front().displacement;
    sorted.sort(grains, reaches, {moved.x(), moved.y(), poses.front().across}, diameter);
    Box all;
    for (const Cluster& cluster : sorted.clusters) all.include(cluster.box.low), all.include(cluster.box.high);
    // Far enough that no query of one slab reaches the plan of another, even moved by a period.
    stride = sorted.clusters.empty()
                 ? 0
                 : 3 * (all.high.x() - all.low.x()) + 4 * (margin + 2 * diameter + 2 * sorted.largest);
    tree.update(sorted.clusters.size(), [&](std::size_t c) {
      const Cluster& cluster = sorted.clusters[c];
      return in_plan(cluster.box, cluster.largest, cluster.slab * stride);
    });
  }

  /// The clusters whose balls may be nearer than `margin` to one of a cluster moved by (shift_x, 0, shift_z).
  void find_clusters(const Cluster& cluster, double margin, double shift_x, double shift_z,
                     std::vector<int>& found) const {
    found.clear();
    Box moved = cluster.box;
    const Eigen::Vector3d shift(shift_x, 0, shift_z);
    moved.low += shift, moved.high += shift;
    const double reach = cluster.largest + margin, highest = reach + sorted.largest;
    const int from = std::max(0, sorted.slab_at(moved.low.y() - highest));
    const int to = std::min(sorted.slabs - 1, sorted.slab_at(moved.high.y() + highest));
    const auto near_in_height = [&](int number) {
      const Cluster& other = sorted.clusters[static_cast<std::size_t>(number)];
      const double apart = reach + other.largest;
      if (other.box.low.y() <= moved.high.y() + apart && other.box.high.y() >= moved.low.y() - apart)
        found.push_back(number);
    };
    for (int slab = from; slab <= to; ++slab) tree.query(in_plan(moved, reach, slab * stride), near_in_height);
  }

  /// For each ball of the clusters [from, to), moved: the numbers of those that are nearer than r + r + margin (m) to
  /// it, where `all` is not set only of those with higher numbers than its own.
  void look_around(int range, std::size_t from, std::size_t to, double margin, double shift_x, double shift_z,
                   bool all) {
    Part& part = parts[static_cast<std::size_t>(range)];
    rows.begin_range(range);
    for (std::size_t c = from; c < to; ++c) {
      const Cluster& cluster = sorted.clusters[c];
      find_clusters(cluster, margin, shift_x, shift_z, part.found);
      gather(part.found, part.around);
      for (std::size_t k = cluster.begin; k < cluster.end; ++k) {
        const int grain = sorted.grain[k];
        int* near = rows.room(range, part.around.grain.size() + 16);
        const int count = near_places(part.around.view(), part.around.y.data(), all ? -1 : grain, sorted.x[k] + shift_x,
                                      sorted.z[k] + shift_z, sorted.y[k], sorted.r[k] + margin, near);
        rows.found(range, grain, count);
      }
    }
  }

  void gather(const std::vector<int>& clusters, Around& around) const {
    around.resize(clusters.size() * cluster_size + widest);
    std::size_t count = 0;
    for (const int c : clusters) {
      const Cluster& cluster = sorted.clusters[static_cast<std::size_t>(c)];
      for (std::size_t k = cluster.begin; k < cluster.end; ++k, ++count) {
        around.grain[count] = sorted.grain[k], around.r[count] = sorted.r[k];
        around.x[count] = sorted.x[k], around.y[count] = sorted.y[k], around.z[count] = sorted.z[k];
      }
    }
    // Whole vectors of the widest kind: what is added has no number that any grain looks for.
    const std::size_t padded = (count + widest - 1) / widest * widest;
    for (; count < padded; ++count) {
      around.grain[count] = -1;
      around.x[count] = around.y[count] = around.z[count] = around.r[count] = 0;
    }
    around.resize(padded);
  }

  /// All faces whose boxes a cluster's box meets, for each of the cluster's balls.
  void look_for_walls(Part& part, std::size_t from, std::size_t to, double margin) const {
    part.walls.clear();
    for (std::size_t c = from; c < to; ++c) {
      const Cluster& cluster = sorted.clusters[c];
      const double reach = cluster.largest_to_walls + margin;
      walls_in(world, in_plan(cluster.box, reach, 0), part.found);
      std::erase_if(part.found, [&](int number) {
        const Wall& wall = walls[static_cast<std::size_t>(number)];
        const double zero = zero_of(wall.vessel).y();
        return zero + wall.box.low.y() > cluster.box.high.y() + reach ||
               zero + wall.box.high.y() < cluster.box.low.y() - reach;
      });
      for (std::size_t k = cluster.begin; k < cluster.end; ++k)
        for (const int wall : part.found) part.walls.push_back({sorted.grain[k], wall, 0.0});
    }
  }

  void find_pairs(const Ranges& ranges, double margin, double shift_x, double shift_z, bool all, PairList& pairs) {
    parts.resize(static_cast<std::size_t>(ranges.count));
    rows.begin(sorted.grain.size(), ranges.count);
    share_clusters(ranges, sorted.clusters.size(), [&](int range, std::size_t from, std::size_t to) {
      look_around(range, from, to, margin, shift_x, shift_z, all);
    });
    rows.transpose(pairs);
  }
};

Broadphase3d::Broadphase3d(const std::vector<Vessel>& vessels, double unit, InstructionSet instructions)
    : world_(std::make_unique<World>(unit, instructions)) {
  World& w = *world_;
  w.vessels = vessels;
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    const Vessel& vessel = vessels[v];
    b2BodyDef definition;
    definition.type = v == 0 ? b2_kinematicBody : b2_staticBody;
    w.bodies.push_back(w.world.CreateBody(&definition));
    w.rest.emplace_back(vessel.origin.x(), vessel.front);
    w.height.push_back(vessel.origin.y());
    for (const Face& face : vessel_faces(vessel)) {
      w.walls.push_back({w.bodies.back(), v, face, box_of(face, vessel, {})});
      w.create_fixture(w.walls.size() - 1);
    }
  }
}

Broadphase3d::~Broadphase3d() = default;

void Broadphase3d::remove_wall(int number) {
  World::Wall& wall = world_->walls[static_cast<std::size_t>(number)];
  if (wall.fixture) wall.body->DestroyFixture(wall.fixture);
  wall.fixture = nullptr;
}

void Broadphase3d::restore_wall(int wall) {
  world_->create_fixture(static_cast<std::size_t>(wall));
}

void Broadphase3d::find(const Grains& grains, const std::vector<Pose>& poses, const Reaches& reaches, double margin,
                        const Ranges& ranges, PairList& pairs, std::vector<WallCandidate>& near_walls) {
  World& w = *world_;
  w.poses = poses;
  w.place_vessels();
  w.turn_walls();
  w.update_boxes(grains, reaches, margin);
  w.find_pairs(ranges, margin, 0, 0, false, pairs);

  share_clusters(ranges, w.sorted.clusters.size(), [&](int range, std::size_t from, std::size_t to) {
    w.look_for_walls(w.parts[static_cast<std::size_t>(range)], from, to, margin);
  });
  join_walls(w.parts, near_walls);
}

void Broadphase3d::find_across(double shift_x, double shift_z, double margin, const Ranges& ranges, PairList& pairs) {
  // As in 2D: who is moved is the row's grain i, so the others are looked for moved the other way.
  world_->find_pairs(ranges, margin, -shift_x, -shift_z, true, pairs);
}

}  // namespace vibrosow
