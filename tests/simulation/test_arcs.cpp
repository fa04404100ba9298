// Arcs as walls: true arcs in the contact, found through Box2D like straight walls.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/nearest_point.hpp"

namespace vibrosow {
namespace {

constexpr double pi = std::numbers::pi;

WallPiece arc(double x, double y, double radius, double from, double to) {
  WallPiece piece;
  piece.centre = {x, y}, piece.radius = radius, piece.from = from, piece.to = to;
  return piece;
}

double shell_stiffness() {
  return Bench::mass * standard_gravity / (1e-4 * Bench::radius);
}

TEST(Arc, PushesOnceAlongItsRadiusFromBothSides) {
  const double ring = 0.1, overlap = 1e-6, force = shell_stiffness() * overlap;
  for (const bool inside : {true, false})
    for (const double angle : {pi + 0.3, 1.5 * pi, 2 * pi - 0.01}) {
      Bench bench;
      bench.scene.tray.pieces = {arc(0.5, 0.5, ring, pi, 2 * pi)};
      const double distance = inside ? ring - Bench::radius + overlap : ring + Bench::radius - overlap;
      bench.place(0.5 + distance * std::cos(angle), 0.5 + distance * std::sin(angle));
      const Simulation& run = bench.start(1e-9);
      const double outward = inside ? -1 : 1;
      EXPECT_NEAR(run.field().forces()[0].fx, outward * force * std::cos(angle), 1e-6 * force);
      EXPECT_NEAR(run.field().forces()[0].fy, outward * force * std::sin(angle), 1e-6 * force);
      EXPECT_EQ(run.statistics().contacts, 1);
    }
}

TEST(Arc, BeyondItsSectorItsEndPushes) {
  Bench bench;  // a quarter from (0.6, 0.5) up to (0.5, 0.6); the grain lies below the first end
  bench.scene.tray.pieces = {arc(0.5, 0.5, 0.1, 0, pi / 2)};
  const double overlap = 1e-6, force = shell_stiffness() * overlap, angle = -1.2;
  const double distance = Bench::radius - overlap;
  bench.place(0.6 + distance * std::cos(angle), 0.5 + distance * std::sin(angle));
  const Simulation& run = bench.start(1e-9);
  EXPECT_NEAR(run.field().forces()[0].fx, force * std::cos(angle), 1e-6 * force);
  EXPECT_NEAR(run.field().forces()[0].fy, force * std::sin(angle), 1e-6 * force);
}

TEST(Arc, ALineThatRunsIntoItIsFeltOnce) {
  // A wall comes down to (0.4, 0.5) and turns into a quarter circle there: at the joint there is one contact.
  const double overlap = 1e-6, force = shell_stiffness() * overlap;
  for (const double y : {0.5 + 1e-5, 0.5, 0.5 - 1e-5}) {
    Bench one;
    one.scene.tray.pieces = {{{0.4, 0.8}, {0.4, 0.5}}, arc(0.5, 0.5, 0.1, pi, 1.5 * pi)};
    one.place(0.4 + Bench::radius - overlap, y);
    const Simulation& run = one.start(1e-9);
    EXPECT_EQ(run.statistics().contacts, 1) << y;
    EXPECT_NEAR(run.field().forces()[0].fx, force, 1e-3 * force) << y;
  }
}

TEST(Arc, SlidingAroundInsideACircleKeepsEnergy) {
  // No gravity, no friction: the grain runs round the inside at constant speed, pressed by its own inertia.
  Bench bench;
  bench.scene.contact.shell_compression = 1e-3;
  bench.scene.tray.pieces = {arc(0.5, 0.5, 0.1, 0.2, 0.2 + 2 * pi)};
  const double orbit = 0.1 - Bench::radius, speed = 0.5;
  bench.place(0.5, 0.5 - orbit, speed, 0);
  Simulation& run = bench.start(bench.contact_time() / 200);
  const double before = kinetic_energy(run.grains());
  int quadrants_seen = 0;
  while (run.time() < 3 * 2 * pi * orbit / speed) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    const double dx = run.grains().x[0] - 0.5, dy = run.grains().y[0] - 0.5;
    ASSERT_NEAR(std::hypot(dx, dy), orbit, 0.02 * Bench::radius);
    quadrants_seen |= 1 << ((dx > 0 ? 1 : 0) + (dy > 0 ? 2 : 0));
  }
  EXPECT_EQ(quadrants_seen, 15) << "all the way round";
  EXPECT_NEAR(kinetic_energy(run.grains()) + run.field().elastic_energy(), before, 1e-4 * before);
  EXPECT_EQ(run.result().balance.lost, 0);
}

TEST(Arc, RollingInAConcaveArcKeepsEnergyAndSwingsWithItsPeriod) {
  // A disc that rolls in a trough without slipping: T = 2 pi sqrt(3 (R - r) / (2 g)), small swings.
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.shell_compression = 1e-4;
  bench.scene.contact.seed.friction = bench.scene.contact.wall.friction = 1;
  bench.scene.contact.slip_speed = 1e-4;
  bench.scene.tray.pieces = {arc(0.5, 0.5, 0.2, pi, 2 * pi)};
  const double orbit = 0.2 - Bench::radius * (1 - 1e-4), swing = 0.02;
  bench.place(0.5 + orbit * std::sin(swing), 0.5 - orbit * std::cos(swing));
  Simulation& run = bench.start(2e-6);
  const double period = 2 * pi * std::sqrt(1.5 * orbit / standard_gravity);
  double crossed = 0;
  while (run.time() < 0.6 * period) {
    const double before = run.grains().x[0];
    ASSERT_TRUE(run.step());
    if (crossed == 0 && before >= 0.5 && run.grains().x[0] < 0.5) crossed = run.time();
  }
  EXPECT_NEAR(crossed, period / 4, 0.005 * period / 4);
}

Scene bowl() {
  Scene scene = Bench().scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 0.6}, {"small", 4e-3, 8e-5, Shape::ball, 0.4}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.length = 0.2;
  scene.tray.height = 0.2;
  scene.tray.box = false;
  scene.tray.holes = {{0.1, 0.04}};
  scene.tray.pieces = {{{0, 0.2}, {0, 0.1}},
                       arc(0.1, 0.1, 0.1, pi, 1.5 * pi - 0.2),
                       arc(0.1, 0.1, 0.1, 1.5 * pi + 0.2, 2 * pi),
                       {{0.2, 0.1}, {0.2, 0.2}},
                       arc(0.1, 0.08, 0.01, 0, 2 * pi)};  // a round bar above the opening
  scene.tray.fill = Fill{150, Packing::poured, 1e-3, false};
  scene.tray.motion = RockingMotion{{0.1, 0.1}, 0.15, 5, 0.1};
  scene.run.duration = 0.6;
  return scene;
}

TEST(Arc, NoContactIsMissedInABowlThatRocks) {
  const Scene scene = bowl();
  Simulation run(with_step(prepare(scene), 2e-5), 3);
  std::size_t met = 0;
  for (int step = 0; step < 30000; ++step) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    if (step % 11 != 0) continue;
    const Grains& grains = run.grains();
    const std::vector<PlacedWall>& walls = run.field().walls().placed();
    std::set<std::pair<int, int>> all, found;
    for (std::size_t i = 0; i < grains.size(); ++i)
      for (std::size_t w = 0; w < walls.size(); ++w) {
        const NearestPoint nearest = nearest_point(walls[w], grains.x[i], grains.y[i]);
        if (std::sqrt(nearest.distance2) < grains.kind(i).radius) all.emplace(static_cast<int>(i), static_cast<int>(w));
      }
    for (const WallCandidate& c : run.state().contacts.walls) {
      const std::size_t i = static_cast<std::size_t>(c.grain);
      const NearestPoint nearest = nearest_point(walls[static_cast<std::size_t>(c.wall)], grains.x[i], grains.y[i]);
      const bool touches = std::sqrt(nearest.distance2) < grains.kind(i).radius;
      if (!touches) continue;
      ASSERT_TRUE(found.emplace(c.grain, c.wall).second) << "each wall once";
    }
    ASSERT_EQ(found, all) << "step " << step;
    met += all.size();
  }
  EXPECT_GT(met, 10000u);
  EXPECT_GT(run.result().balance.counted, 20);
  EXPECT_EQ(run.result().balance.lost, 0);
}

}  // namespace
}  // namespace vibrosow
