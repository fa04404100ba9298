// Contacts found through Box2D against brute force, over whole runs.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/nearest_point.hpp"

namespace vibrosow {
namespace {

/// A small tray that is shaken hard under a hopper that stands still and is kept topped up; two sizes of grain.
Scene busy_scene(Space space = Space::two_dimensional) {
  Scene scene;
  scene.space = space;
  if (space == Space::three_dimensional) scene.tray.depth = 0.03, scene.tray.front_and_back = Sides::periodic;
  scene.lots = {{"big", 8e-3, 6e-4, Shape::ball, 0.6}, {"small", 5e-3, 1.5e-4, Shape::ball, 0.4}};
  scene.contact.shell_compression = 3e-4;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.name = "tray";
  scene.tray.length = 0.2;
  scene.tray.height = 0.08;
  scene.tray.tilt = 0.05;
  scene.tray.holes = {{0.06, 0.02}, {0.14, 0.03}};
  scene.tray.fill = Fill{100, Packing::poured, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0.4, 5e-3, 12, 0};
  Vessel hopper;
  hopper.name = "hopper";
  hopper.origin = {0.05, 0.11};
  hopper.length = 0.1;
  hopper.height = 0.1;
  hopper.funnel = 0.7;
  hopper.holes = {{0.05, 0.03}};
  hopper.fill = Fill{60, Packing::poured, 1e-3, true};
  if (space == Space::three_dimensional) {
    hopper.depth = 0.02, hopper.front = 0.005, hopper.funnel = 0;
    scene.tray.fill->count = 300;
    for (Hole& hole : scene.tray.holes) hole.shape = HoleShape::round, hole.across = 0.015;
  }
  scene.hopper = hopper;
  scene.run.duration = 1;
  return scene;
}

std::unique_ptr<Simulation> start(const Scene& scene, NeighbourMargins margins = {}) {
  return std::make_unique<Simulation>(with_step(prepare(scene), 2.5e-5), 7, ComputeOptions{.margins = margins});
}

using Contacts = std::set<std::pair<int, int>>;

Contacts touching(const Grains& grains, const PairList& pairs) {
  Contacts contacts;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(pairs.grain[k]), j = static_cast<std::size_t>(pairs.partner[k]);
    if ((grains.place(i) - grains.place(j)).norm() < grains.kind(i).radius + grains.kind(j).radius)
      contacts.emplace(pairs.grain[k], pairs.partner[k]);
  }
  return contacts;
}

PairList every_pair(std::size_t grains) {
  PairList all;
  for (int i = 0; i < static_cast<int>(grains); ++i)
    for (int j = 0; j < i; ++j) all.add(i, j);
  return all;
}

Contacts touching_walls(const Grains& grains, const std::vector<PlacedWall>& walls,
                        const std::vector<WallCandidate>* candidates) {
  Contacts contacts;
  const auto look = [&](int i, int w) {
    const std::size_t k = static_cast<std::size_t>(i);
    const NearestPoint nearest = nearest_point(walls[static_cast<std::size_t>(w)], grains.x[k], grains.y[k]);
    if (nearest.distance2 < grains.kind(k).radius * grains.kind(k).radius) contacts.emplace(i, w);
  };
  if (candidates) {
    for (const WallCandidate& c : *candidates) look(c.grain, c.wall);
  } else {
    for (int i = 0; i < static_cast<int>(grains.size()); ++i)
      for (int w = 0; w < static_cast<int>(walls.size()); ++w) look(i, w);
  }
  return contacts;
}

TEST(Neighbours, MissNoContactOfAWholeRun) {
  const auto run = start(busy_scene());
  std::size_t pairs = 0, walls = 0;
  for (int step = 0; step < 40000; ++step) {
    ASSERT_TRUE(run->step()) << *run->guard().stop_reason();
    if (step % 13 != 0) continue;
    // Lists are those of the last force evaluation, which a velocity Verlet step makes at its end.
    const Grains& grains = run->grains();
    const ContactState& contacts = run->state().contacts;
    const Contacts found = touching(grains, contacts.pairs), all = touching(grains, every_pair(grains.size()));
    ASSERT_EQ(found, all) << "step " << step;
    const std::vector<PlacedWall>& placed = run->field().walls().placed();
    const Contacts found_walls = touching_walls(grains, placed, &contacts.walls);
    ASSERT_EQ(found_walls, touching_walls(grains, placed, nullptr)) << "step " << step;
    pairs += all.size(), walls += found_walls.size();
  }
  EXPECT_GT(pairs, 100000u);
  EXPECT_GT(walls, 20000u);
  EXPECT_GT(run->result().balance.counted, 20);
  EXPECT_GT(run->result().balance.put_in, 160) << "the hopper must have been topped up";
  EXPECT_LT(run->field().neighbours().searches(), 5000) << "lists must last";
}

TEST(Neighbours, MissNoPairOfAWholeRun3d) {
  const auto run = start(busy_scene(Space::three_dimensional));
  std::size_t pairs = 0;
  for (int step = 0; step < 20000; ++step) {
    ASSERT_TRUE(run->step()) << *run->guard().stop_reason();
    if (step % 17 != 0) continue;
    const Grains& grains = run->grains();
    const Contacts found = touching(grains, run->state().contacts.pairs);
    ASSERT_EQ(found, touching(grains, every_pair(grains.size()))) << "step " << step;
    pairs += found.size();
  }
  EXPECT_GT(pairs, 20000u);
  EXPECT_GT(run->result().balance.counted, 3);
  EXPECT_LT(run->field().neighbours().searches(), 2500) << "lists must last";
}

TEST(Neighbours, OutliveGrainsThatGoOnAsTheyDid) {
  // A swarm flies 0.8 m past a tray and two grains at rest: a hundred diameters.
  for (const Space space : both_spaces) {
    Bench bench(space);
    bench.place(0.5, 0.5).place(0.5, 0.51);
    for (int k = 0; k < 6; ++k) bench.place(0.05 + 0.009 * k, 0.2, 2, 0);
    Simulation& run = bench.start(1e-5);
    run.steps(40000);
    const double margin = space == Space::two_dimensional ? NeighbourMargins{}.wide : NeighbourMargins{}.wide_3d;
    const double by_its_way_alone = 0.8 / (0.5 * margin * 2 * Bench::radius);
    EXPECT_LT(static_cast<double>(run.field().neighbours().searches()), 0.5 * by_its_way_alone);
  }
}

// A grain's lists last longer the farther it flies on as it did, at last over many of its diameters: the wall at the
// end of its way must be in them.
TEST(Neighbours, SeeTheWallAtTheEndOfALongWay) {
  for (const Space space : both_spaces)
    for (const Eigen::Vector3d& to : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, -1, 0),
                                      Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1)}) {
      if (to.z() != 0 && space == Space::two_dimensional) continue;
      Bench bench(space);
      constexpr double speed = 2, way = 0.5 - Bench::radius;
      Simulation& run = bench.place(Eigen::Vector3d(0.5, 0.5, 0.5), speed * to).start(1e-5);
      ASSERT_TRUE(run.run_until(0.4)) << *run.guard().stop_reason();
      const Eigen::Vector3d middle(0.5, 0.5, space == Space::two_dimensional ? 0 : 0.5);
      const double flown = speed * (run.time() - bench.contact_time());
      EXPECT_LT((velocity_of(run.grains(), 0) + speed * to).norm(), 1e-3 * speed) << to.transpose();
      EXPECT_LT((place_of(run.grains(), 0) - middle - (2 * way - flown) * to).norm(), 0.1 * Bench::radius);
      EXPECT_LT(run.field().neighbours().searches(), 40) << "lists must last";
    }
}

TEST(Neighbours, MarginsChangeNoBit) {
  const auto narrow = start(busy_scene(), {.wide = 0.4, .narrow = 0.02});
  const auto wide = start(busy_scene(), {.wide = 2.0, .narrow = 0.5});
  narrow->steps(20000);
  wide->steps(20000);
  EXPECT_NE(narrow->field().neighbours().prunes(), wide->field().neighbours().prunes());
  ASSERT_EQ(narrow->grains().id, wide->grains().id);
  EXPECT_EQ(narrow->grains().x, wide->grains().x);
  EXPECT_EQ(narrow->grains().y, wide->grains().y);
  EXPECT_EQ(narrow->grains().omega, wide->grains().omega);
}

TEST(Neighbours, MarginsChangeNoLossThroughAWall) {
  // Shells so soft that many grains are pressed through the floor.
  Scene scene = busy_scene();
  scene.contact.shell_compression = 0.3;
  scene.guard.stop_relative_overlap = 100;
  scene.guard.energy_tolerance = 1e9;
  scene.tray.motion = HarmonicMotion{1.2, 8e-3, 25, 0};
  std::vector<std::int64_t> lost;
  std::vector<std::vector<double>> heights;
  for (const NeighbourMargins margins :
       {NeighbourMargins{0.4, 0.02}, NeighbourMargins{1.5, 0.15}, NeighbourMargins{2.0, 0.5}}) {
    const auto run = start(scene, margins);
    run->steps(10000);
    lost.push_back(run->result().balance.lost);
    heights.push_back(run->grains().y);
  }
  EXPECT_GT(lost[0], 20);
  EXPECT_EQ(lost[0], lost[1]);
  EXPECT_EQ(lost[0], lost[2]);
  EXPECT_EQ(heights[0], heights[1]);
  EXPECT_EQ(heights[0], heights[2]);
}

}  // namespace
}  // namespace vibrosow
