// Pairs and walls that Box2D's plan finds against all that there are.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "box2d/broadphase_3d.hpp"
#include "grains/random.hpp"
#include "vessel/nearest_on_face.hpp"

namespace vibrosow {
namespace {

constexpr double largest = 4e-3;  // m, diameter

Vessel box() {
  Vessel vessel;
  vessel.name = "tray";
  vessel.length = 0.04, vessel.height = 0.05, vessel.depth = 0.03;
  vessel.holes = {{.centre = 0.02, .width = 0.008, .shape = HoleShape::round, .across = 0.015}};
  return vessel;
}

Grains scattered(std::size_t count, std::uint64_t seed) {
  Grains grains({{largest / 2, 1e-5, 1e5, 1e10, 1e-3}}, true, true);
  grains.is_3d = true;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    GrainKind kind = grains.kinds.front();
    kind.radius *= random.uniform(0.4, 1);
    grains.add(Eigen::Vector3d(random.uniform(0, 0.04), random.uniform(-0.01, 0.05), random.uniform(0, 0.03)),
               Eigen::Vector3d::Zero(), 0, kind);
  }
  return grains;
}

/// Every tenth looks two diameters farther than its radius for pairs, three for walls.
Reaches some_far(const Grains& grains) {
  Reaches reaches = reaches_at_rest(grains);
  for (std::size_t i = 0; i < grains.size(); i += 10) reaches.pair[i] += 2 * largest, reaches.wall[i] += 3 * largest;
  return reaches;
}

using Pair = std::pair<int, int>;
std::vector<Pair> pairs_in(const PairList& list) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < list.size(); ++k) pairs.emplace_back(list.grain[k], list.partner[k]);
  return pairs;
}

std::vector<Pair> all_near(const Grains& g, const Reaches& reaches, double margin, double shift_x, double shift_z,
                           bool lower_alone) {
  std::vector<Pair> pairs;
  const int n = static_cast<int>(g.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < (lower_alone ? i : n); ++j) {
      const std::size_t a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double dx = g.x[b] - g.x[a] - shift_x, dy = g.y[b] - g.y[a], dz = g.z[b] - g.z[a] - shift_z;
      if (std::sqrt(dx * dx + dy * dy + dz * dz) < reaches.pair[a] + reaches.pair[b] + margin) pairs.emplace_back(i, j);
    }
  return pairs;
}

Ranges shared_by(int count) {
  return {count, [count](const auto& work) {
            for (int range = 0; range < count; ++range) work(range);
          }};
}

TEST(Broadphase3d, FindsJustThePairsThereAre) {
  for (const std::size_t count : {0u, 1u, 7u, 300u, 2000u})
    for (const double margin : {0.0, 1e-3, 8e-3}) {
      const Grains grains = scattered(count, count + 1);
      const Reaches reaches = some_far(grains);
      Broadphase3d search({box()}, largest, best_instruction_set());
      PairList pairs;
      std::vector<WallCandidate> walls;
      search.find(grains, {{{0.003, 0.002}, 0, 0.001}}, reaches, margin, shared_by(3), pairs, walls);
      EXPECT_EQ(pairs_in(pairs), all_near(grains, reaches, margin, 0, 0, true)) << count << ", " << margin;
    }
}

TEST(Broadphase3d, FindsPairsAcrossABoundary) {
  const Grains grains = scattered(500, 3);
  const Reaches reaches = some_far(grains);
  Broadphase3d search({box()}, largest, best_instruction_set());
  PairList pairs;
  std::vector<WallCandidate> walls;
  search.find(grains, {{}}, reaches, 2e-3, shared_by(2), pairs, walls);
  for (const auto& [x, z] : {std::pair(0.04, 0.0), std::pair(0.0, 0.03), std::pair(0.04, -0.03)}) {
    search.find_across(x, z, 2e-3, shared_by(2), pairs);
    EXPECT_EQ(pairs_in(pairs), all_near(grains, reaches, 2e-3, x, z, false)) << x << ", " << z;
  }
}

TEST(Broadphase3d, MissesNoFaceWhereverItsVesselIs) {
  const Grains grains = scattered(800, 5);
  Vessel hopper = box();
  hopper.name = "hopper", hopper.origin = {0.01, 0.02};
  for (const double tilt : {0.0, 0.3}) {
    hopper.tilt = tilt;
    const std::vector<Vessel> vessels = {box(), hopper};
    Broadphase3d search(vessels, largest, best_instruction_set());
    Walls walls(vessels, Space::three_dimensional);
    PairList pairs;
    std::vector<WallCandidate> near;
    const Reaches reaches = some_far(grains);
    search.find(grains, walls.poses(), reaches, 1e-3, shared_by(1), pairs, near);
    EXPECT_TRUE(std::ranges::is_sorted(near, {}, [](const WallCandidate& c) { return std::pair(c.grain, c.wall); }));
    for (std::size_t i = 0; i < grains.size(); ++i)
      for (std::size_t wall = 0; wall < walls.count(); ++wall) {
        const double reach = reaches.wall[i] + 1e-3;
        const NearestOnFace nearest =
            nearest_on_face(walls.placed_faces()[wall], {grains.x[i], grains.y[i], grains.z[i]});
        if (nearest.distance2 >= reach * reach) continue;
        const bool found = std::ranges::any_of(near, [&](const WallCandidate& c) {
          return c.grain == static_cast<int>(i) && c.wall == static_cast<int>(wall);
        });
        EXPECT_TRUE(found) << "grain " << i << ", wall " << wall;
      }
    EXPECT_LT(near.size(), grains.size() * walls.count() / 2);
  }
}

TEST(Broadphase3d, ARemovedFaceIsNotFoundAndARestoredOneIs) {
  const Grains grains = scattered(100, 7);
  Broadphase3d search({box()}, largest, best_instruction_set());
  PairList pairs;
  std::vector<WallCandidate> near;
  const auto of_wall_0 = [&] {
    search.find(grains, {{}}, reaches_at_rest(grains), 1e-3, shared_by(1), pairs, near);
    return std::ranges::count(near, 0, &WallCandidate::wall);
  };
  const auto before = of_wall_0();
  EXPECT_GT(before, 0);
  search.remove_wall(0);
  EXPECT_EQ(of_wall_0(), 0);
  search.restore_wall(0);
  EXPECT_EQ(of_wall_0(), before);
}

}  // namespace
}  // namespace vibrosow
