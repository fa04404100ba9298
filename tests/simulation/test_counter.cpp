// Counting grains at holes, and the balance put in = inside + counted + spilled + lost.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/clump_shape.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

void expect_balanced(const Balance& b) {
  EXPECT_EQ(b.put_in, b.inside + b.counted + b.spilled + b.lost);
}

TEST(Counter, AGrainBelongsToTheHoleItsCentrePasses) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{0.3, 0.04}, {0.7, 0.05}};
  bench.place(0.7, 0.1).place(0.3, 0.2);
  Simulation& run = bench.start(1e-4);
  run.steps(4000);
  const vibrosow::Run result = run.result();
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_EQ(result.events[0].hole, 2);
  EXPECT_EQ(result.events[1].hole, 1);
  EXPECT_EQ(result.events[0].grain, 0);
  EXPECT_NEAR(result.events[0].x, 0.7, 1e-12);
  // Free fall of 0.1 m to the floor and 20 mm on to the line, interpolated well below the step.
  const double fall = 0.12;
  const double speed = std::sqrt(2 * fall * standard_gravity), step = 1e-4;
  EXPECT_NEAR(result.events[0].time, speed / standard_gravity, standard_gravity * step * step / (2 * speed));
  EXPECT_NEAR(result.events[0].speed, speed, standard_gravity * step * 1.001);
  EXPECT_EQ(result.balance.counted, 2);
  EXPECT_EQ(run.grains().size(), 0u) << "counted grains are taken out";
  EXPECT_NEAR(result.tray_empty_since, std::sqrt(2 * 0.2 / standard_gravity), 2e-3);
  expect_balanced(result.balance);
}

TEST(Counter, EventsComeByTimeNotByGrain) {
  // Both cross the line in the same step, the second grain first.
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{0.3, 0.04}, {0.7, 0.05}};
  bench.place(0.3, 0.1 + 5e-5).place(0.7, 0.1);
  Simulation& run = bench.start(1e-4);
  run.steps(4000);
  const vibrosow::Run result = run.result();
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_LT(result.events[0].time, result.events[1].time);
  EXPECT_EQ(result.events[0].grain, 1);
}

TEST(Counter, PassesInTheTraysFrame) {
  // The tray swings to the left under a grain that falls straight down: it passes the hole that lies there then.
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{0.5, 0.03}};
  bench.scene.tray.motion = HarmonicMotion{0, 0.05, 1.25, 0};
  const double fall_time = std::sqrt(2 * 0.1 / standard_gravity);
  const double shift = vessel_pose(bench.scene.tray, fall_time).displacement.x();
  ASSERT_GT(std::abs(shift), 0.03) << "the hole must have left its place at rest";
  bench.place(0.5 + shift, 0.1);
  Simulation& run = bench.start(1e-4);
  run.steps(3000);
  ASSERT_EQ(run.result().events.size(), 1u);
  EXPECT_EQ(run.result().events[0].hole, 1);
  EXPECT_NEAR(run.result().events[0].x, 0.5, 1e-4);
}

TEST(Counter, BesideTheTrayIsSpilled) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.place(-0.1, 0.05).place(1.2, 0.05);
  Simulation& run = bench.start(1e-4);
  run.steps(3000);
  EXPECT_EQ(run.result().balance.spilled, 2);
  EXPECT_EQ(run.result().balance.counted, 0);
  expect_balanced(run.result().balance);
}

TEST(Counter, ThrownBackUpIsNotCounted) {
  Bench bench;
  bench.scene.tray.holes = {{0.5, 0.1}};
  bench.gravity = {0, 0.2};  // falls through the hole and comes back up before the line
  bench.place(0.5, 0.005, 0, -0.08);
  Simulation& run = bench.start(1e-4);
  run.steps(20000);
  EXPECT_EQ(run.result().balance.counted, 0);
  EXPECT_EQ(run.result().balance.inside, 1);
}

TEST(Counter, AGrainThroughAWallIsLostNotCounted) {
  Bench bench;
  bench.gravity = {0, 0};
  bench.scene.guard.stop_relative_overlap = 100;  // otherwise the guard stops first, see stability
  bench.scene.contact.shell_compression = 0.1;
  bench.place(0.5, 0.02, 0, -3);
  Simulation& run = bench.start(1e-5);
  run.steps(2000);
  EXPECT_EQ(run.result().balance.lost, 1);
  EXPECT_EQ(run.result().balance.counted, 0);
  expect_balanced(run.result().balance);
}

TEST(Counter, AClumpIsCountedWhereTheEdgeSlipsIntoItsWaist) {
  Scene scene = Bench().scene;
  scene.lots = {{"dipole", 0.03, Bench::mass, Shape::clump, 1.0}};
  scene.lots[0].discs = dipole(0.01, 0.02);
  scene.lots[0].gyration2 = plate_of(scene.lots[0].discs).gyration2;
  scene.tray.holes = {{0.2, 0.05}, {0.5, 0.1}};
  // Upright, the rod 1 mm beside the second opening, 45 to 55 cm: between its discs it is through the floor already.
  for (const double x : {0.449, 0.43}) {
    Grains grains(prepare(scene).kinds, true, true, true);
    grains.add(x, 1e-6, 0, -1, 0, grains.kinds[0], std::numbers::pi / 2);
    Walls walls({scene.tray});
    walls.place(0);
    CounterState state{.passages = {{}}, .below = {0}};
    Counter counter(scene, state);
    std::vector<OutflowEvent> events;
    const GrainLoops& loops = grain_loops(InstructionSet::generic);
    counter.watch(grains, walls, loops, 0, events);
    for (const double y : {-1e-6, -0.021}) grains.y[0] = y, counter.watch(grains, walls, loops, 1e-3, events);
    const bool in_reach = x > 0.435;
    ASSERT_EQ(events.size(), in_reach ? 1u : 0u);
    if (in_reach) {
      EXPECT_EQ(events[0].hole, 2);
    }
    EXPECT_EQ(counter.lost(), in_reach ? 0 : 1);
  }
}

TEST(Counter, FeedingKeepsTheBalance) {
  Scene scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 1.0}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.name = "tray";
  scene.tray.length = 0.1;
  scene.tray.height = 0.15;
  scene.tray.holes = {{0.05, 0.035}};
  scene.tray.fill = Fill{150, Packing::poured, 1e-3, true};
  scene.run.duration = 1.0;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
  EXPECT_GT(run.balance.counted, 50);
  EXPECT_GT(run.balance.put_in, 150);
  EXPECT_EQ(run.balance.lost, 0);
  // Never more than 5 ms of outflow short.
  EXPECT_NEAR(static_cast<double>(run.balance.inside), 150, 12);
  expect_balanced(run.balance);
}

TEST(Counter, APauseEndsTheRunWhereThatIsAsked) {
  Scene scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 1.0}};
  scene.contact.shell_compression = 1e-3;
  scene.tray.name = "tray";
  scene.tray.length = 0.1;
  scene.tray.height = 0.15;
  scene.tray.fill = Fill{5, Packing::poured, 1e-3, false};
  scene.run.duration = 0.6;
  scene.run.measure_from = 0.5;
  const vibrosow::Run whole = simulate(scene);
  EXPECT_TRUE(whole.end_reason.empty());
  EXPECT_GT(whole.measured_wall_time, 0);
  EXPECT_LT(whole.measured_wall_time, whole.wall_time);
  scene.run.end_after_pause = 0.2;
  const vibrosow::Run closed = simulate(scene);
  EXPECT_EQ(closed.status, RunStatus::finished);
  EXPECT_EQ(closed.end_reason, "no grain left for 0.2 s; 5 are still inside");
  EXPECT_EQ(closed.measured_wall_time, 0) << "the window was not reached";
  EXPECT_NEAR(closed.end_time, 0.2, 2e-3);
  scene.tray.holes = {{0.05, 0.09, 0.1}};  // open from 0.1 s
  const vibrosow::Run opened = simulate(scene);
  ASSERT_GT(opened.balance.counted, 0);  // one may lie on a ledge
  EXPECT_NEAR(opened.end_time, opened.events.back().time + 0.2, 2e-3);
}

}  // namespace
}  // namespace vibrosow
