// Balls that leave a vessel in 3D and come into it: counted at the hole they pass, rained, topped up.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

Scene tray() {
  Scene scene;
  scene.space = Space::three_dimensional;
  scene.lots = {{"ball", 4e-3, 4e-5, Shape::ball, 1}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.4, 0.6, 0, 0};
  scene.tray.name = "tray";
  scene.tray.length = 0.06, scene.tray.height = 0.06, scene.tray.depth = 0.04;
  scene.run.duration = 0.5;
  return scene;
}

Hole round_hole(double centre, double across, double width) {
  return {centre, width, 0, HoleShape::round, across, 0};
}

struct Dropped {
  double x, y, z;
};

vibrosow::Run run_of(const Scene& scene, const std::vector<Dropped>& balls) {
  const Model model = prepare_to_run(scene);
  Grains grains = no_grains(model);
  for (const Dropped& ball : balls)
    grains.add({ball.x, ball.y, ball.z}, Eigen::Vector3d::Zero(), 0, grains.kinds.front());
  Simulation run(model, starting_state(model, 1, grains));
  run.run_until(scene.run.duration);
  return run.result();
}

TEST(Outflow3d, ABallBelongsToTheRoundHoleItPasses) {
  Scene scene = tray();
  scene.tray.holes = {round_hole(0.02, 0.01, 0.012), round_hole(0.02, 0.03, 0.012), round_hole(0.045, 0.02, 0.012)};
  const vibrosow::Run run =
      run_of(scene, {{0.045, 0.02, 0.0205}, {0.02, 0.03, 0.031}, {0.021, 0.04, 0.01}, {0.02, 0.02, 0.02}});
  ASSERT_EQ(run.events.size(), 3u);
  EXPECT_EQ(run.events[0].hole, 3);
  EXPECT_EQ(run.events[1].hole, 2);
  EXPECT_EQ(run.events[2].hole, 1);
  EXPECT_NEAR(run.events[0].x, 0.045, 1e-12);
  EXPECT_NEAR(run.events[0].z, 0.0205, 1e-12);
  EXPECT_NEAR(run.events[1].z, 0.031, 1e-12);
  EXPECT_NEAR(run.events[0].speed, std::sqrt(2 * standard_gravity * 0.04), 1e-3);
  EXPECT_EQ(run.balance.inside, 1) << "between two holes the floor holds";
  EXPECT_EQ(run.balance.lost, 0);
}

TEST(Outflow3d, OffAChamferABallFallsIntoItsHole) {
  Scene scene = tray();
  scene.tray.holes = {round_hole(0.03, 0.02, 0.01)};
  const Dropped beside{0.0355, 0.0025, 0.02};  // its centre is over the floor, half a millimetre from the hole
  EXPECT_EQ(run_of(scene, {beside}).balance.inside, 1);
  scene.tray.holes[0].thickness = scene.tray.holes[0].chamfer = 1.5e-3;
  const vibrosow::Run run = run_of(scene, {beside});
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].hole, 1);
}

TEST(Outflow3d, TheWallOfAHoleInAThickFloorHoldsABall) {
  Scene scene = tray();
  scene.tray.holes = {round_hole(0.03, 0.02, 0.01)};
  const auto furthest = [&] {  // of a ball that is thrown sideways below the upper edge
    const Model model = prepare_to_run(scene);
    Grains grains = no_grains(model);
    grains.add({0.03, -0.0025, 0.02}, {0.3, 0, 0}, 0, grains.kinds.front());
    Simulation run(model, starting_state(model, 1, grains));
    double most = 0;
    while (run.time() < 0.02 && run.step()) most = std::max(most, run.grains().x[0] - 0.03);
    return most;
  };
  EXPECT_GT(furthest(), 5e-3);
  scene.tray.holes[0].thickness = 8e-3;
  EXPECT_NEAR(furthest(), 0.5 * (0.01 - 4e-3), 2e-4);
}

TEST(Outflow3d, ASlotEndsWhereItEnds) {
  Scene scene = tray();
  scene.tray.holes = {{0.03, 0.02, 0, HoleShape::slot, 0.02, 0.02}};
  const vibrosow::Run run = run_of(scene, {{0.03, 0.01, 0.028}, {0.03, 0.01, 0.004}});
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].hole, 1);
  EXPECT_EQ(run.balance.inside, 1);
}

TEST(Outflow3d, OverTheFrontItIsSpilled) {
  Scene scene = tray();
  scene.tray.front_and_back = Sides::open;
  const vibrosow::Run run = run_of(scene, {{0.03, 0.01, -0.01}, {0.03, 0.01, 0.05}, {-0.01, 0.01, 0.02}});
  EXPECT_EQ(run.balance.spilled, 3);
  EXPECT_EQ(run.balance.lost, 0);
}

TEST(Outflow3d, ItPassesInTheTraysFrameAcrossToo) {
  // The tray swings straight across under a ball that falls down where the hole is then.
  Scene scene = tray();
  scene.tray.depth = 0.2;
  scene.tray.holes = {round_hole(0.03, 0.1, 0.012)};
  HarmonicMotion across{0, 0.03, 2, 0};
  across.across = 0.5 * 3.14159265358979323846;
  scene.tray.motion = across;
  const double fall_time = std::sqrt(2 * 0.05 / standard_gravity);
  const double shift = 0.03 * std::sin(2 * 3.14159265358979323846 * 2 * fall_time);
  ASSERT_GT(std::abs(shift), 0.02);
  const vibrosow::Run run = run_of(scene, {{0.03, 0.05, 0.1 + shift}});
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].hole, 1);
  EXPECT_NEAR(run.events[0].z, 0.1, 1e-4);
}

TEST(Outflow3d, ATrayDrainsThroughItsRoundHoles) {
  Scene scene = tray();
  scene.run.duration = 1.5;
  scene.tray.holes = {round_hole(0.02, 0.02, 0.022), round_hole(0.045, 0.02, 0.022)};
  scene.tray.fill = Fill{600, Packing::poured, 0, false};
  const vibrosow::Run run = simulate(scene);
  const Balance& b = run.balance;
  EXPECT_EQ(b.put_in, 600);
  EXPECT_EQ(b.put_in, b.inside + b.counted + b.spilled + b.lost);
  EXPECT_EQ(b.lost, 0);
  EXPECT_EQ(b.spilled, 0);
  EXPECT_GT(b.counted, 300);
  for (const OutflowEvent& event : run.events) {
    const Hole& hole = scene.tray.holes[static_cast<std::size_t>(event.hole - 1)];
    EXPECT_LE(std::hypot(event.x - hole.centre, event.z - hole.across), 0.5 * hole.width);
  }
}

TEST(Outflow3d, AConeEmptiesAndARoundHopperFeedsTheTray) {
  Scene scene = tray();
  scene.run.duration = 3;
  scene.tray.holes = {round_hole(0.03, 0.02, 0.03)};
  Vessel hopper;
  hopper.name = "hopper";
  hopper.plan = Plan::round;
  hopper.length = 0.04, hopper.depth = 0.04, hopper.height = 0.1;
  hopper.origin = {0.01, 0.06};
  hopper.front = 0;
  hopper.funnel = 0.9;
  hopper.holes = {round_hole(0.02, 0.02, 0.024)};
  hopper.fill = Fill{300, Packing::poured, 0, false};
  scene.hopper = hopper;
  const vibrosow::Run run = simulate(scene);
  const Balance& b = run.balance;
  EXPECT_EQ(b.put_in, b.inside + b.counted + b.spilled + b.lost);
  EXPECT_EQ(b.lost, 0);
  EXPECT_GT(b.counted, 200);
}

TEST(Outflow3d, KeptToppedUpItStaysFull) {
  Scene scene = tray();
  scene.run.duration = 0.6;
  scene.tray.holes = {round_hole(0.03, 0.02, 0.024)};
  scene.tray.fill = Fill{500, Packing::poured, 0, true};
  const vibrosow::Run run = simulate(scene);
  EXPECT_GT(run.balance.counted, 30);
  EXPECT_GE(run.balance.inside, 480);
  EXPECT_EQ(run.balance.lost, 0);
  EXPECT_EQ(run.balance.put_in, run.balance.inside + run.balance.counted + run.balance.spilled);
}

TEST(Outflow3d, RainFallsAllOverTheDepth) {
  for (const Plan plan : {Plan::rectangle, Plan::round}) {
    Scene scene = tray();
    scene.tray.plan = plan;
    if (plan == Plan::round) scene.tray.depth = scene.tray.length;
    scene.tray.rain = Rain{1000, 0, scene.tray.length, 0.05};
    const Model model = prepare_to_run(scene);
    Simulation run(model, 1);
    run.run_until(0.3);
    const Grains& grains = run.grains();
    ASSERT_GT(grains.size(), 280u);
    const auto [least, most] = std::ranges::minmax(grains.z);
    EXPECT_LT(least, 0.2 * *scene.tray.depth);
    EXPECT_GT(most, 0.8 * *scene.tray.depth);
    EXPECT_GE(least, 0.0019);
    EXPECT_EQ(run.result().balance.lost, 0);
    EXPECT_EQ(run.result().balance.inside, static_cast<std::int64_t>(grains.size()));
  }
}

TEST(Outflow3d, APeriodicSliceCountsWithinItsPeriod) {
  Scene scene = tray();
  scene.run.duration = 1;
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  scene.tray.holes = {round_hole(0.05, 0.03, 0.02)};  // its rim ends on the period's
  scene.tray.fill = Fill{500, Packing::poured, 0, false};
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.lost, 0);
  EXPECT_EQ(run.balance.spilled, 0);
  EXPECT_GT(run.balance.counted, 30);
  for (const OutflowEvent& event : run.events) EXPECT_LE(std::hypot(event.x - 0.05, event.z - 0.03), 0.01);
}

}  // namespace
}  // namespace vibrosow
