// Seeds that rain into a vessel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "grains/places.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

Scene wet() {
  Scene scene = Bench().scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 0.6}, {"small", 4e-3, 8e-5, Shape::ball, 0.4}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.length = 0.2;
  scene.tray.height = 0.1;
  scene.tray.rain = Rain{200, 0, 0.2, 0.1};
  scene.run.duration = 0.5;
  return scene;
}

void expect_balanced(const Balance& b) {
  EXPECT_EQ(b.put_in, b.inside + b.counted + b.spilled + b.lost);
}

TEST(Rain, BringsRateTimesTime) {
  Scene scene = wet();
  scene.tray.rain->stop = 0.45;  // leaves time for those that wait
  EXPECT_EQ(simulate(scene).balance.put_in, 90);
  scene.tray.rain->start = 0.1;
  scene.tray.rain->stop = 0.3;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.put_in, 40);
  EXPECT_EQ(run.balance.inside, 40);
  EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
  expect_balanced(run.balance);
}

TEST(Rain, ThatFellBehindForAWhileIsTold) {
  const auto told = [](const vibrosow::Run& run) {
    std::vector<std::string> texts;
    for (const Doubt& doubt : run.warnings)
      if (doubt.kind == DoubtKind::feeder_behind) texts.push_back(doubt.text);
    return texts;
  };
  Scene scene = wet();
  scene.tray.rain->rate = 100, scene.tray.rain->stop = 0.3;
  scene.run.duration = 1.5;
  EXPECT_THAT(told(simulate(scene)), testing::IsEmpty());
  scene.tray.rain->from = 0.09, scene.tray.rain->to = 0.1;  // hardly as wide as a seed
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.put_in, 30) << "after it had stopped";
  EXPECT_THAT(told(run), testing::ElementsAre(testing::MatchesRegex(
                             "tray.rain falls behind: at 0.* s [0-9]+ of [0-9]+ seeds waited for want of room, and "
                             "they came later.*")));
}

/// Of a disc's area a quarter lies within half its radius, and as much in each of eight sectors.
TEST(Rain, OnARoundVesselIsEvenOverItsFloor) {
  Vessel vessel;
  vessel.plan = Plan::round;
  vessel.length = 0.1, vessel.depth = 0.1;
  constexpr double radius = 2e-3, room = 0.05 - radius;
  constexpr int seeds = 20000;
  Random random(3);
  int within = 0;
  std::array<int, 8> sectors{};
  for (int k = 0; k < seeds; ++k) {
    const FloorPlace from_middle = random_place(vessel, radius, radius, 0.1 - radius, random) - FloorPlace(0.05, 0.05);
    ASSERT_LE(from_middle.norm(), room * (1 + 1e-12));
    within += from_middle.norm() < room / 2 ? 1 : 0;
    const double turn = std::atan2(from_middle.y(), from_middle.x()) / (2 * std::numbers::pi);
    ++sectors.at(static_cast<std::size_t>(8 * (turn < 0 ? turn + 1 : turn)) % 8);
  }
  const auto expect_share = [&](int count, double share) {
    EXPECT_NEAR(count, share * seeds, 4 * std::sqrt(share * (1 - share) * seeds));
  };
  expect_share(within, 0.25);
  for (const int count : sectors) expect_share(count, 0.125);
  for (const double edge : {radius, 0.1 - radius}) {  // where the floor has no width
    const FloorPlace place = random_place(vessel, radius, edge, edge, random);
    EXPECT_NEAR(place.x(), edge, 1e-12);
    EXPECT_NEAR(place.y(), 0.05, 1e-9);
  }
}

TEST(Rain, ThroughTheHolesTheBalanceHolds) {
  Scene scene = wet();
  scene.tray.holes = {{0.1, 0.05}};
  scene.tray.motion = HarmonicMotion{0, 5e-3, 9, 0.1};
  scene.tray.fill = Fill{50, Packing::poured, 1e-3, false};
  scene.tray.rain->stop = 0.45;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.put_in, 140);
  EXPECT_GT(run.balance.counted, 20);
  EXPECT_EQ(run.balance.lost, 0);
  expect_balanced(run.balance);
}

TEST(Rain, ComesAtRestInTheLabWithinItsRangeAndOverlapsNothing) {
  Scene scene = wet();
  scene.tray.rain = Rain{2000, 0.05, 0.12, 0.08};  // more than the place takes
  scene.tray.motion = HarmonicMotion{0, 5e-3, 9, 0};
  Simulation run(with_step(prepare(scene), 2e-5), 1);
  std::size_t seen = 0;
  double least = 1, most = 0;
  for (int step = 0; step < 10000; ++step) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    const Grains& g = run.grains();
    for (; seen < g.size(); ++seen) {
      EXPECT_EQ(g.vx[seen], 0);
      EXPECT_EQ(g.vy[seen], 0);
      EXPECT_NEAR(g.y[seen], 0.08, 1e-15);
      const double along = g.x[seen] - run.field().walls().poses().front().displacement.x();
      least = std::min(least, along), most = std::max(most, along);
      for (std::size_t i = 0; i < seen; ++i)
        ASSERT_GT(std::hypot(g.x[i] - g.x[seen], g.y[i] - g.y[seen]), g.kind(i).radius + g.kind(seen).radius);
    }
  }
  EXPECT_GT(seen, 50u);
  EXPECT_LT(seen, 400u) << "some had to wait";
  EXPECT_GE(least, 0.05);
  EXPECT_LE(most, 0.12);
  EXPECT_LT(least, 0.055);
  EXPECT_GT(most, 0.115);
  EXPECT_EQ(run.result().balance.put_in, static_cast<std::int64_t>(seen));
}

Scene wet_and_tilted(Space space, double tilt) {
  Scene scene = wet();
  scene.space = space;
  if (space == Space::three_dimensional) scene.tray.depth = 0.05;
  scene.tray.tilt = tilt, scene.tray.height = 0.04;
  return scene;
}

TEST(Rain, OverATiltedTrayFallsIntoItsOpening) {
  for (const Space space : both_spaces)
    for (const double tilt : {-0.35, 0.0, 0.35}) {
      Scene scene = wet_and_tilted(space, tilt);
      scene.tray.rain = Rain{200, 0, 0.2, 0.2, 0, 0.15};
      scene.contact.seed = scene.contact.wall = {0.3, 0.1};
      scene.run.duration = 0.6;
      const Model model = prepare(scene);
      Simulation run(model, 1);
      while (run.grains().size() == 0) ASSERT_TRUE(run.step());
      const Eigen::Vector3d own = point_in_vessel(scene.tray, {}, run.grains().place(0));
      EXPECT_NEAR(own.y(), 0.2, 1e-3) << "the height is above the floor";
      ASSERT_TRUE(run.run_until(scene.run.duration)) << *run.guard().stop_reason();
      const Balance balance = run.result().balance;
      EXPECT_EQ(balance.put_in, 30);
      EXPECT_EQ(balance.inside, 30) << "tilted by " << tilt;
      EXPECT_EQ(run.result().tray_at_end, 30);
    }
}

TEST(Rain, OverATiltedTrayComesDownPlumbOnItsRangeOfTheOpening) {
  for (const Space space : both_spaces)
    for (const double tilt : {-0.35, 0.35}) {
      Scene scene = wet_and_tilted(space, tilt);
      scene.tray.rain = Rain{200, 0.09, 0.11, 0.2, 0, 0.1};
      Simulation run(prepare(scene), 1);
      const auto own = [&](const Eigen::Vector3d& at) { return point_in_vessel(scene.tray, {}, at); };
      const Eigen::Vector3d down = own(-Eigen::Vector3d::UnitY()) - own(Eigen::Vector3d::Zero());
      std::size_t seen = 0;
      while (run.time() < 0.1) {
        ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
        for (; seen < run.grains().size(); ++seen) {
          const Eigen::Vector3d from = own(run.grains().place(seen));
          const double opening = from.x() + (scene.tray.height - from.y()) / down.y() * down.x();
          EXPECT_GE(opening, 0.09 - 1e-9) << "tilted by " << tilt;
          EXPECT_LE(opening, 0.11 + 1e-9) << "tilted by " << tilt;
        }
      }
      EXPECT_GT(seen, 5u);
    }
}

TEST(Rain, WaitsWhileATableHasTippedTheTrayOver) {
  Scene scene = wet();
  scene.tray.fill = Fill{10, Packing::layers, 0, true};
  scene.tray.motion = TableMotion{{0, 0.05, 0.25, 0.3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 2.8, 2.8}, {}};
  scene.tray.rain->start = 0.25;
  scene.run.duration = 0.6;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.put_in, 10);
  EXPECT_EQ(std::ranges::count(run.warnings, DoubtKind::feeder_behind, &Doubt::kind), 2) << "of the fill and the rain";
}

TEST(Rain, FallsAsFreelyUnderEveryScheme) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5}) {
    Scene scene = wet();
    scene.numerics.integrator = integrator;
    scene.tray.rain = Rain{100, 0.1, 0.1, 0.09, 0, 0.015};  // one, at 10 ms
    Simulation run(with_step(prepare(scene), 2e-5), 1);
    while (run.grains().size() == 0) ASSERT_TRUE(run.step());
    const double came = run.time();
    while (run.time() < came + 0.1) ASSERT_TRUE(run.step());
    const double fell = run.time() - came;
    EXPECT_NEAR(run.grains().vy[0], -standard_gravity * fell, 1e-10);
    EXPECT_NEAR(run.grains().y[0], 0.09 - 0.5 * standard_gravity * fell * fell, 1e-10);
  }
}

TEST(Rain, HasARandomStreamOfItsOwn) {
  const auto places = [](std::uint64_t random_seed) {
    const Scene scene = wet();
    Simulation run(with_step(prepare(scene), 2e-5), random_seed);
    run.steps(3000);
    return run.grains().x;
  };
  EXPECT_EQ(places(1), places(1));
  EXPECT_NE(places(1), places(2));
}

TEST(Rain, IntoAPeriodicTrayKeepsClearOfTheImages) {
  Scene scene = wet();
  scene.tray.length = 0.04;
  scene.tray.sides = Sides::periodic;
  scene.tray.rain = Rain{2000, 0, 0.04, 0.08};
  Simulation run(with_step(prepare(scene), 2e-5), 1);
  std::size_t seen = 0;
  double nearest_across = 1;
  for (int step = 0; step < 4000; ++step) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    const Grains& g = run.grains();
    for (; seen < g.size(); ++seen)
      for (std::size_t i = 0; i < seen; ++i) {
        const double dx = std::abs(g.x[i] - g.x[seen]), dy = g.y[i] - g.y[seen];
        const double gap = std::hypot(0.04 - dx, dy) - g.kind(i).radius - g.kind(seen).radius;
        nearest_across = std::min(nearest_across, gap);
      }
  }
  EXPECT_GT(seen, 10u);
  EXPECT_GT(nearest_across, 0);
}

}  // namespace
}  // namespace vibrosow
