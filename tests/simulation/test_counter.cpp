// Counting grains at holes, and the balance put in = inside + counted + spilled + lost.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "scene/clump_shape.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"

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

TEST(Counter, WhatTheTrayHoldsIsNotedWhenMeasuringBegins) {
  for (const double measure_from : {0.0, 0.15}) {
    Bench bench;
    bench.gravity = {0, -standard_gravity};
    bench.scene.tray.holes = {{0.3, 0.04}, {0.7, 0.05}};
    bench.scene.run.measure_from = measure_from, bench.scene.run.duration = 0.4;
    bench.place(0.7, 0.1).place(0.3, 0.2);  // below the floor from 0.14 and 0.2 s on
    Simulation& run = bench.start(1e-4);
    run.steps(1000);
    EXPECT_EQ(run.result().tray_at_begin, measure_from == 0 ? 2 : -1);
    EXPECT_EQ(run.result().tray_at_end, 2);
    run.steps(800);
    EXPECT_EQ(run.result().tray_at_begin, measure_from == 0 ? 2 : 1);
    EXPECT_EQ(run.result().tray_at_end, 1);
    run.steps(700);
    EXPECT_EQ(run.result().tray_at_begin, measure_from == 0 ? 2 : 1);
    EXPECT_EQ(run.result().tray_at_end, 0);
  }
}

TEST(Counter, WhatATableTippedOutIsSpilled) {
  for (const Space space : both_spaces)
    for (const bool back : {false, true}) {
      Scene scene = Bench(space).scene;
      scene.contact.shell_compression = 1e-3;
      scene.contact.seed.restitution = scene.contact.wall.restitution = 0.5;
      scene.tray.length = 0.1, scene.tray.height = 0.06;
      if (space == Space::three_dimensional) scene.tray.depth = 0.05;
      scene.tray.holes = {{.centre = 0.05, .width = 1e-3, .across = 0.02, .across_length = 0.01}};
      scene.tray.fill = Fill{20, Packing::layers, 1e-3, false};
      scene.tray.motion = TableMotion{{0, 0.05, 0.15, 0.3, 0.5, 0.6},
                                      {0, 0, 0, 0, 0, 0},
                                      {0, 0, 0, 0, 0, 0},
                                      {0, 0, 1.4, 2.8, 2.8, back ? 0.0 : 2.8},
                                      {}};
      scene.run.duration = 0.8;
      const vibrosow::Run run = simulate(scene);
      EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
      EXPECT_EQ(run.balance.inside, 0);
      EXPECT_EQ(run.balance.spilled, 20);
      EXPECT_EQ(run.balance.lost, 0);
      EXPECT_EQ(run.tray_at_end, 0);
    }
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

TEST(Counter, AnEventHasItsOwnGrainsMass) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.lots = {{"light", 6e-3, 2e-4, Shape::ball, 0.5}, {"heavy", 6e-3, 5e-4, Shape::ball, 0.5}};
  bench.scene.lots[1].sizes = {SizeDistribution::Kind::uniform, 6e-3, 0, 5e-3, 7e-3, {}, {}};
  bench.scene.tray.holes = {{0.3, 0.2}};
  bench.place(0.25, 0.05, 0, 0, 0, 0).place(0.35, 0.06, 0, 0, 0, 1);
  Simulation& run = bench.start(1e-4);
  run.grains().mass[1] = 4e-4;  // one of the smaller of its lot
  run.steps(3000);
  ASSERT_EQ(run.result().events.size(), 2u);
  EXPECT_EQ(run.result().events[0].mass, 2e-4);
  EXPECT_EQ(run.result().events[1].mass, 4e-4);
}

/// The time, between two, at which a function that falls is nothing.
template <class Function>
double time_of_zero(double from, double to, Function function) {
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (from + to);
    (function(middle) > 0 ? from : to) = middle;
  }
  return from;
}

// Between two steps a grain goes on with its speed in the tray's frame: how far it is off is of second order.
TEST(Counter, PlaceAndTimeAreThoseBetweenTwoSteps) {
  constexpr double quarter = std::numbers::pi / 2;
  const HarmonicMotion along{0, 0.05, 2, 0, 0.3}, up{quarter, 0.05, 2, 0, 0.3};
  HarmonicMotion across = along;
  across.across = quarter;
  struct Case {
    Space space;
    VesselMotion motion;
  };
  for (const Case& c :
       {Case{Space::two_dimensional, along}, Case{Space::two_dimensional, up},
        Case{Space::two_dimensional, RockingMotion{{0.2, 0}, 0.1, 2}}, Case{Space::three_dimensional, across},
        Case{Space::three_dimensional, TurningMotion{{0.5, 0.5}, 1, TurningAxis::upright}}}) {
    Bench bench(c.space);
    bench.scene.tray.motion = c.motion;
    bench.scene.tray.holes = {{.centre = 0.45, .width = 0.3}};
    if (c.space == Space::three_dimensional)
      bench.scene.tray.holes[0].across = 0.5, bench.scene.tray.holes[0].across_length = 0.3;
    const Eigen::Vector3d from(0.4, 0.0504, 0.45), velocity(0.2, -1, 0.1);  // it passes well within a step
    bench.place(from, velocity);
    Simulation& run = bench.start(1e-3);
    while (run.result().events.empty()) ASSERT_TRUE(run.step() && run.time() < 1);
    const Vessel& tray = bench.scene.tray;
    const auto own = [&](double time) {
      const Eigen::Vector3d at =
          from + time * (c.space == Space::two_dimensional ? Eigen::Vector3d(0.2, -1, 0) : velocity);
      return point_in_vessel(tray, vessel_pose(tray, time), at);
    };
    const double passed = time_of_zero(0, 0.2, [&](double time) { return own(time).y(); });
    const double counted = time_of_zero(0, 0.2, [&](double time) { return own(time).y() + 0.02; });
    const OutflowEvent event = run.result().events[0];
    EXPECT_EQ(event.hole, 1);
    EXPECT_NEAR(event.x, own(passed).x(), 1e-5) << c.motion.index();
    if (c.space == Space::three_dimensional) {
      EXPECT_NEAR(event.z, own(passed).z(), 1e-5) << c.motion.index();
    }
    EXPECT_NEAR(event.time, counted, 1e-5) << c.motion.index();
    EXPECT_NEAR(event.speed, c.space == Space::two_dimensional ? std::hypot(0.2, 1) : velocity.norm(), 1e-12);
  }
}

TEST(Counter, AGrainThrownBackUpBelongsToTheHoleItLeavesThroughAtLast) {
  Bench bench;
  bench.scene.tray.holes = {{0.3, 0.1}, {0.6, 0.1}};
  bench.place(0.3, 0.005, 0, -1);
  Simulation& run = bench.start(1e-4);
  run.steps(100);  // 5 mm below the floor
  ASSERT_LT(run.grains().y[0], 0);
  run.grains().vy[0] = 1;
  run.steps(200);
  ASSERT_GT(run.grains().y[0], 0.01);
  run.grains().x[0] = 0.6, run.grains().vy[0] = -1;
  run.steps(500);
  ASSERT_EQ(run.result().events.size(), 1u);
  EXPECT_EQ(run.result().events[0].hole, 2);
  EXPECT_NEAR(run.result().events[0].x, 0.6, 1e-12);
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

class LostGrain : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Counter, LostGrain, testing::ValuesIn(both_spaces), named_by_space);

// So soft and so fast that its overlap goes from 0.8 radii on one side of the floor to 0.8 on the other.
TEST_P(LostGrain, ThroughAWallStopsTheRun) {
  for (const bool down : {true, false}) {  // through the floor, or the right wall
    Bench bench(GetParam());
    bench.scene.contact.shell_compression = 10;
    bench.scene.guard.stop_relative_overlap = 0.95;
    constexpr double dt = 1e-4, stride = 0.4 * Bench::radius, away = 0.2 * Bench::radius + 3 * stride;
    bench.place(down ? 0.5 : 1 - away, down ? away : 0.5, down ? 0 : stride / dt, down ? -stride / dt : 0);
    Simulation& run = bench.start(dt);
    run.steps(20);
    ASSERT_TRUE(run.guard().stop_reason());
    EXPECT_NE(run.guard().stop_reason()->find(" went through a wall at "), std::string::npos)
        << *run.guard().stop_reason();
    EXPECT_EQ(run.result().status, RunStatus::stopped_by_guard);
    EXPECT_EQ(run.result().balance.lost, 1);
    expect_balanced(run.result().balance);
  }
}

TEST(Counter, OfSeveralClumpsTheOneThatWentThroughAWallIsLost) {
  Bench bench;
  bench.scene.lots.clear();
  bench.add_clump(dipole(2 * Bench::radius, 2.2 * Bench::radius), Bench::mass);
  bench.scene.contact.shell_compression = 10;
  bench.scene.guard.stop_relative_overlap = 100;
  constexpr double dt = 1e-4, stride = 0.4 * Bench::radius;
  bench.place(0.2, 0.5).place(0.5, 0.2 * Bench::radius + 3 * stride, 0, -stride / dt).place(0.8, 0.5);
  Simulation& run = bench.start(dt);
  run.steps(20);
  EXPECT_EQ(run.result().balance.lost, 1);
  EXPECT_EQ(run.grains().id, (std::vector<std::int64_t>{0, 2}));
}

TEST(Counter, AGrainThatComesThroughTheFloorWithoutAWallStopsTheRun) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.place(0.5, 2 * Bench::radius);
  Simulation& run = bench.start(1e-4);
  const std::vector<WallSegment> walls = vessel_walls(bench.scene.tray);
  for (std::size_t w = 0; w < walls.size(); ++w)
    if (walls[w].name.find("floor") != std::string::npos)
      run.field().neighbours().broadphase().remove_wall(static_cast<int>(w));
  run.field().neighbours().start_afresh();
  run.steps(3000);
  ASSERT_TRUE(run.guard().stop_reason());
  EXPECT_NE(run.guard().stop_reason()->find(" went through a wall at "), std::string::npos);
  EXPECT_EQ(run.result().balance.lost, 1);
  expect_balanced(run.result().balance);
}

/// By which hole a dipole is counted, 0 spilled, whose centre passes the floor at `x`, upright: between its discs it is
/// through the floor already. None where it is lost.
std::optional<int> hole_of_dipole(Scene scene, double x) {
  scene.lots = {{"dipole", 0.03, Bench::mass, Shape::clump, 1.0}};
  scene.lots[0].discs = dipole(0.01, 0.02);
  scene.lots[0].gyration2 = plate_of(scene.lots[0].discs).gyration2;
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
  EXPECT_EQ(events.size() + counter.lost_now().size(), 1u);
  return events.empty() ? std::nullopt : std::optional(events[0].hole);
}

TEST(Counter, AClumpIsCountedWhereTheEdgeSlipsIntoItsWaist) {
  Scene scene = Bench().scene;
  scene.tray.holes = {{0.2, 0.05}, {0.5, 0.1}};
  EXPECT_EQ(hole_of_dipole(scene, 0.449), 2) << "1 mm beside the opening, 45 to 55 cm";
  EXPECT_EQ(hole_of_dipole(scene, 0.43), std::nullopt);
}

/// The tray is a metre long.
TEST(Counter, AClumpMayHangOverAnOpenEndOrAHoleAcrossASeam) {
  Scene scene = Bench().scene;
  for (const double x : {0.001, 0.999}) {
    scene.tray.sides = Sides::walls;
    EXPECT_EQ(hole_of_dipole(scene, x), std::nullopt) << "it went through the floor";
    scene.tray.sides = Sides::open;
    EXPECT_EQ(hole_of_dipole(scene, x), 0) << x;
  }
  EXPECT_EQ(hole_of_dipole(scene, 0.1), std::nullopt);
  scene.tray.sides = Sides::periodic;
  scene.tray.holes = {{0.05, 0.1}};  // from the seam on
  EXPECT_EQ(hole_of_dipole(scene, 0.999), 1);
  EXPECT_EQ(hole_of_dipole(scene, 0.9), std::nullopt);
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

Scene small_tray() {
  Scene scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 1.0}};
  scene.contact.shell_compression = 1e-3;
  scene.tray.name = "tray";
  scene.tray.length = 0.1;
  scene.run.duration = 0.6;
  return scene;
}

TEST(Counter, APauseEndsTheRunWhereThatIsAsked) {
  Scene scene = small_tray();
  scene.tray.height = 0.15;
  scene.tray.fill = Fill{5, Packing::poured, 1e-3, false};
  scene.run.measure_from = 0.5;
  const vibrosow::Run whole = simulate(scene);
  EXPECT_TRUE(whole.end_reason.empty());
  EXPECT_GT(whole.measured_cpu_time, 0);
  scene.run.end_after_pause = 0.2;
  const vibrosow::Run closed = simulate(scene);
  EXPECT_EQ(closed.status, RunStatus::finished);
  EXPECT_EQ(closed.end_reason, "no grain left for 0.2 s; 5 are still inside");
  EXPECT_EQ(closed.measured_cpu_time, 0) << "the window was not reached";
  EXPECT_NEAR(closed.end_time, 0.2, 2e-3);
  scene.tray.holes = {{0.05, 0.09, 0.1}};  // open from 0.1 s
  const vibrosow::Run opened = simulate(scene);
  ASSERT_GT(opened.balance.counted, 0);  // one may lie on a ledge
  EXPECT_NEAR(opened.end_time, opened.events.back().time + 0.2, 2e-3);
}

TEST(Counter, APauseBeginsWhenHopperAndRainHaveBegun) {
  Scene scene = small_tray();
  scene.tray.height = 0.05;
  scene.run.end_after_pause = 0.1;
  Scene with_hopper = scene;
  Vessel& hopper = with_hopper.hopper.emplace(scene.tray);
  hopper.name = "hopper", hopper.origin.y() = 0.06;
  hopper.fill = Fill{5, Packing::poured, 1e-3, false};
  hopper.holes = {{0.05, 0.03, 0.3}};
  EXPECT_NEAR(simulate(with_hopper).end_time, 0.4, 2e-3);
  scene.tray.rain = Rain{.rate = 10, .from = 0, .to = 0.1, .height = 0.04, .start = 0.2};
  EXPECT_NEAR(simulate(scene).end_time, 0.3, 2e-3);
}

}  // namespace
}  // namespace vibrosow
