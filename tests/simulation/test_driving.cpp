#include <gtest/gtest.h>

#include <stdexcept>

#include "simulation/simulation.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

Scene gated_box() {
  Scene scene = Bench().scene;
  scene.tray.length = 0.1, scene.tray.height = 0.1;
  scene.tray.holes = {{0.05, 0.04, 1000}};
  scene.tray.fill = Fill{40, Packing::layers, 0, false};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.run.duration = 2;
  return scene;
}

TEST(Driving, AGateOpensAndClosesFromOutside) {
  Simulation run(with_step(prepare(gated_box()), 5e-5), 1);
  ASSERT_TRUE(run.run_until(0.1));
  EXPECT_EQ(run.events_since(0).size(), 0u);
  run.open_gate("tray", 1);
  ASSERT_TRUE(run.run_until(0.3));
  const std::size_t out = run.events_since(0).size();
  EXPECT_GT(out, 3u);
  while (!run.close_gate("tray", 1)) ASSERT_TRUE(run.step());  // as soon as no grain is in its way
  ASSERT_TRUE(run.run_until(run.time() + 0.2));
  const std::size_t shut = run.events_since(0).size();
  ASSERT_TRUE(run.run_until(run.time() + 0.2));
  EXPECT_EQ(run.events_since(0).size(), shut) << "nothing passes a closed gate";
  EXPECT_EQ(run.events_since(shut).size(), 0u);
  EXPECT_EQ(run.result().balance.lost, 0);
  EXPECT_THROW(run.open_gate("tray", 2), std::invalid_argument);
}

TEST(Driving, InAPeriodicTrayAGateOpensAndClosesInAllItsPeriods) {
  for (const Space space : both_spaces) {
    Scene scene = gated_box();
    scene.space = space, scene.tray.sides = Sides::periodic;
    scene.lots[0].shape = Shape::ball;
    if (space == Space::three_dimensional) {
      scene.tray.depth = 0.05;
      scene.tray.holes[0].across = 0.025, scene.tray.holes[0].across_length = 0.04;
    }
    Simulation run(with_step(prepare(scene), 5e-5), 1);
    run.open_gate("tray", 1);
    ASSERT_TRUE(run.run_until(0.15));
    EXPECT_GT(run.events_since(0).size(), 3u);
    while (!run.close_gate("tray", 1)) ASSERT_TRUE(run.step());
    ASSERT_TRUE(run.run_until(run.time() + 0.15));
    const std::size_t shut = run.events_since(0).size();
    ASSERT_TRUE(run.run_until(run.time() + 0.1));
    EXPECT_EQ(run.events_since(0).size(), shut);
    EXPECT_EQ(run.result().balance.lost, 0);
  }
}

TEST(Driving, AMotionGoesOnFromWhereTheVesselIs) {
  Scene scene = gated_box();
  scene.tray.motion = HarmonicMotion{0, 5e-3, 9, 0};
  Simulation run(with_step(prepare(scene), 5e-5), 1);
  ASSERT_TRUE(run.run_until(0.02));
  const double before = run.field().walls().pose(0, run.time()).displacement.x();
  EXPECT_GT(std::abs(before), 1e-3);
  run.set_motion(0, HarmonicMotion{0, 2e-3, 15, 0});
  EXPECT_NEAR(run.field().walls().pose(0, run.time()).displacement.x(), before, 1e-15);
  ASSERT_TRUE(run.run_until(0.2));
  run.set_motion(0, std::nullopt);
  const double still = run.field().walls().pose(0, run.time()).displacement.x();
  ASSERT_TRUE(run.run_until(0.3));
  EXPECT_EQ(run.field().walls().pose(0, run.time()).displacement.x(), still);
  EXPECT_THROW(run.set_motion(1, std::nullopt), std::invalid_argument);
  EXPECT_THROW(run.set_motion(0, RockingMotion{}), std::invalid_argument);
}

TEST(Driving, WatchersLookAtWholeIntervals) {
  Simulation run(with_step(prepare(gated_box()), 5e-5), 1);
  std::vector<double> times;
  run.watch(0.01, [&](Simulation& now) { times.push_back(now.time()); });
  run.run_until(0.05);
  ASSERT_EQ(times.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(times[k], 0.01 * static_cast<double>(k + 1), 1e-12);
}

TEST(Driving, AWatcherMayAddWatchers) {
  Simulation run(with_step(prepare(gated_box()), 5e-5), 1);
  int looks = 0;
  run.watch(0.01, [&looks, text = std::string(64, 'x')](Simulation& now) {
    for (int k = 0; k < 20; ++k) now.watch(0.01, [&looks](Simulation&) { ++looks; });
    EXPECT_EQ(text.size(), 64u);
  });
  ASSERT_TRUE(run.run_until(0.02));
  EXPECT_EQ(looks, 20 + 40);
}

}  // namespace
}  // namespace vibrosow
