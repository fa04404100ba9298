// Vessels in motion: each kind's velocity is the derivative of its pose, and its bounds are bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

Vessel moving(VesselMotion motion) {
  Vessel vessel;
  vessel.name = "tray";
  vessel.length = 0.5;
  vessel.height = 0.1;
  vessel.tilt = 0.1;
  vessel.origin = {0.3, -0.2};
  vessel.motion = std::move(motion);
  return vessel;
}

TableMotion sampled_sine() {
  TableMotion table;
  for (int k = 0; k <= 40; ++k) {
    const double time = 0.1 + 0.0125 * k;
    table.times.push_back(time);
    table.x.push_back(2e-3 * std::sin(20 * time));
    table.y.push_back(1e-3 * std::cos(30 * time));
    table.angle.push_back(0.02 * std::sin(10 * time));
  }
  return table;
}

struct Kind {
  const char* name;
  VesselMotion motion;
};

std::vector<Kind> every_kind() {
  const double stop = 0.4, stop_ramp = 0.15;
  return {{"harmonic", HarmonicMotion{0.7, 0.01, 9, 0.2, 0.4, stop, stop_ramp}},
          {"sum", SumMotion{{{0.7, 0.01, 9, 0.2, 0, stop, stop_ramp}, {1.6, 0.002, 23, 0.2, 1.1, stop, stop_ramp}}}},
          {"rocking", RockingMotion{{0.25, 0.03}, 0.05, 7, 0.2, stop, stop_ramp}},
          {"turning", TurningMotion{{0.25, 0.03}, 3, TurningAxis::across, 0.2, stop, stop_ramp}},
          {"table", sampled_sine()}};
}

TEST(Motion, VelocityIsTheDerivativeOfThePose) {
  for (const Kind& kind : every_kind()) {
    const VesselPath path(moving(kind.motion));
    for (const double t : {0.0, 0.03, 0.1, 0.19, 0.2, 0.35, 0.4, 0.45, 0.549, 0.55, 0.6, 0.61}) {
      const double h = 1e-6;
      const Pose before = path.pose(t - h), after = path.pose(t + h);
      const PoseRate rate = path.rate(t);
      EXPECT_NEAR(((after.displacement - before.displacement) / (2 * h) - rate.velocity).norm(), 0, 1e-4)
          << kind.name << " at " << t;
      EXPECT_NEAR((after.angle - before.angle) / (2 * h), rate.angular_velocity, 1e-4) << kind.name << " at " << t;
    }
  }
}

TEST(Motion, RampsBeginAndEndAtRest) {
  for (const Kind& kind : every_kind()) {
    const VesselPath path(moving(kind.motion));
    for (const double t : {0.0, 0.7}) {
      EXPECT_EQ(path.rate(t).velocity.norm(), 0) << kind.name;
      EXPECT_EQ(path.rate(t).angular_velocity, 0) << kind.name;
      const bool stays_turned = t > 0 && std::holds_alternative<TurningMotion>(kind.motion);
      if (stays_turned || std::holds_alternative<TableMotion>(kind.motion)) continue;
      EXPECT_EQ(path.pose(t).displacement.norm(), 0) << kind.name;
      EXPECT_EQ(path.pose(t).angle, 0) << kind.name;
    }
  }
  EXPECT_NEAR(vessel_velocity(moving(HarmonicMotion{0, 0.01, 9, 0}), 0).velocity.norm(), 0.565, 1e-3)
      << "paper A's case jumps";
}

TEST(Motion, ATableThatHoldsStillDoesNotDrift) {
  TableMotion table;
  table.times = {0, 0.02, 0.04, 0.1, 1.1, 1.16, 1.2, 1.3};
  table.x = {0, 0, 0, 20e-3, 20e-3, 0, 0, 0};
  table.y = {0, 0, 0, 0, 0, 0, 0, 0};
  table.angle = {0.1, 0.1, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3};
  const VesselPath path(moving(table));
  for (double time = 0.1; time < 1.1; time += 0.01) {
    EXPECT_NEAR(path.pose(time).displacement.x(), 20e-3, 1e-12) << time;
    EXPECT_NEAR(path.pose(time).angle, 0.1, 1e-12) << time;
  }
}

TEST(Motion, ATableThatStandsBeforeItSetsOutDoesNotDrift) {
  TableMotion table;
  table.times = {0, 1, 1.1, 1.2, 1.3};
  table.x = table.angle = {0, 0, 20e-3, 20e-3, 20e-3};
  table.y = {0, 0, 0, 0, 0};
  const VesselPath path(moving(table));
  for (double time = 0; time <= 1; time += 0.01) EXPECT_NEAR(path.pose(time).displacement.x(), 0, 1e-12) << time;
}

/// Two rows on both sides of a peak are equal, and yet no hold.
TEST(Motion, ATableOfASampledSineGoesOnOverItsPeak) {
  TableMotion table;
  for (int k = -9; k <= 10; ++k) {
    const double time = (k - 0.5) * 1e-3;
    table.times.push_back(time);
    table.x.push_back(1e-3 * std::cos(2 * std::numbers::pi * 50 * time));
    table.y.push_back(0), table.angle.push_back(0);
  }
  ASSERT_EQ(table.x[9], table.x[10]);
  EXPECT_GT(VesselPath(moving(table)).pose(0).displacement.x(), 1.002 * table.x[9]);
}

/// A cosine of 4 rows a period has slopes of half the fall beside its peak's two rows, of 6 rows three fifths of it:
/// halfway between them the cubic is a fourth of the slope times the step higher.
TEST(Motion, HowFarATableGoesBeyondItsRowsIsKnown) {
  for (const auto& [rows, share] : {std::pair(4, 1.0 / 8), {6, 3.0 / 40}}) {
    TableMotion table;
    for (int k = 0; k < 4 * rows; ++k) {
      table.times.push_back(0.01 * k);
      table.y.push_back(std::cos(2 * std::numbers::pi * (k + 0.5) / rows));
      table.x.push_back(3), table.angle.push_back(0);
    }
    const Overshoot most = largest_overshoot(table);
    EXPECT_EQ(most.column, "y_mm");
    EXPECT_NEAR(most.share, share, 1e-12) << rows;
    EXPECT_NEAR(most.to - most.from, 0.01, 1e-12);
  }
  TableMotion steps;
  steps.times = {0, 0.02, 0.04, 0.1, 1.1, 1.16, 1.2, 1.3};
  steps.x = {0, 0, 0, 20e-3, 20e-3, 0, 0, 0};
  steps.y = steps.angle = {0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_LT(largest_overshoot(steps).share, 1e-12) << "from hold to hold";
}

TEST(Motion, HalfwayThroughARampTheAmplitudeIsHalf) {
  const HarmonicMotion m{0, 0.01, 9, 0.2, 0, 1.0, 0.4};
  const double two_pi = 2 * std::numbers::pi;
  EXPECT_NEAR(vessel_pose(moving(m), 0.1).displacement.x(), 0.5 * 0.01 * std::sin(two_pi * 9 * 0.1), 1e-15);
  EXPECT_NEAR(vessel_pose(moving(m), 1.2).displacement.x(), 0.5 * 0.01 * std::sin(two_pi * 9 * 1.2), 1e-15);
}

TEST(Motion, ASumAddsItsComponents) {
  const HarmonicMotion a{0, 0.01, 9, 0}, b{1, 0.002, 21, 0, 0.3};
  for (const double t : {0.013, 0.4}) {
    const Eigen::Vector2d expected = vessel_pose(moving(a), t).displacement + vessel_pose(moving(b), t).displacement;
    EXPECT_NEAR((vessel_pose(moving(SumMotion{{a, b}}), t).displacement - expected).norm(), 0, 1e-16);
  }
}

TEST(Motion, RockingLeavesThePivotAndTurnsTheRest) {
  const RockingMotion rocking{{0.25, 0.03}, 0.05, 7, 0};
  const Vessel vessel = moving(rocking);
  const Eigen::Vector2d at_rest = in_lab_frame(vessel, {}, rocking.pivot);
  for (const double t : {0.01, 0.05, 0.33}) {
    const Pose pose = vessel_pose(vessel, t);
    const PoseRate rate = vessel_velocity(vessel, t);
    EXPECT_NEAR(pose.angle, 0.05 * std::sin(2 * std::numbers::pi * 7 * t), 1e-15);
    EXPECT_NEAR((in_lab_frame(vessel, pose, rocking.pivot) - at_rest).norm(), 0, 1e-15);
    EXPECT_NEAR(material_velocity(vessel, pose, rate, at_rest).norm(), 0, 1e-15);
    const Eigen::Vector2d own(0.1, 0.02);
    EXPECT_NEAR((in_vessel_frame(vessel, pose, in_lab_frame(vessel, pose, own)) - own).norm(), 0, 1e-15);
  }
}

TEST(Motion, TurningIsTheIntegralOfItsRampedSpeed) {
  const double speed = -5;
  const auto angle = [&](double ramp, double stop, double stop_ramp, double time) {
    return vessel_pose(moving(TurningMotion{{0.1, 0.2}, speed, TurningAxis::across, ramp, stop, stop_ramp}), time)
        .angle;
  };
  EXPECT_NEAR(angle(0, never, 0, 100), speed * 100, 1e-12 * 500);
  EXPECT_NEAR(angle(2, never, 0, 1), speed * 2 * (0.125 - 0.03125), 1e-15);  // T (p^3 - p^4 / 2)
  EXPECT_NEAR(angle(2, never, 0, 7), speed * (7 - 1), 1e-14);
  EXPECT_NEAR(angle(2, 7, 3, 11), speed * (7 - 1 + 1.5), 1e-14);
  EXPECT_NEAR(angle(0, 0.5, 0, 11), speed * 0.5, 1e-15) << "stops at once";
  EXPECT_EQ(angle(2, 7, 3, -1), 0);
  // One that begins to stop before its ramp has ended, against a sum of its speeds.
  const VesselPath path(moving(TurningMotion{{0.1, 0.2}, speed, TurningAxis::across, 2, 1, 3}));
  const int parts = 40000;
  double sum = 0;
  for (int k = 0; k < parts; ++k) sum += path.rate(4.0 * (k + 0.5) / parts).angular_velocity * 4.0 / parts;
  EXPECT_NEAR(path.pose(4).angle, sum, 1e-8);
  EXPECT_EQ(path.pose(5).angle, path.pose(4).angle);
}

TEST(Motion, TurningUprightIsRigidAboutItsAxis) {
  const TurningMotion turning{{0.25, 0.04}, 3, TurningAxis::upright, 0.2, 0.9, 0.3};
  for (const double tilt : {0.0, 0.1}) {
    Vessel vessel = moving(turning);
    vessel.tilt = tilt, vessel.depth = 0.08;
    const VesselPath path(vessel);
    const Eigen::Vector3d on_axis(0.25, 0.05, 0.04), at_rest = point_in_lab(vessel, {}, on_axis);
    for (const double t : {0.1, 0.2, 0.5, 1.0, 1.19, 1.3}) {
      const double h = 1e-6;
      const Pose pose = path.pose(t);
      EXPECT_NEAR((point_in_lab(vessel, pose, on_axis) - at_rest).norm(), 0, 1e-15);
      for (const Eigen::Vector3d& own : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.5, 0.1, 0.08)}) {
        const auto at = [&](double time) { return point_in_lab(vessel, path.pose(time), own); };
        EXPECT_NEAR((at(t) - at_rest).norm(), (own - on_axis).norm(), 1e-15);
        EXPECT_NEAR((point_in_vessel(vessel, pose, at(t)) - own).norm(), 0, 1e-15);
        EXPECT_NEAR((point_velocity(vessel, pose, path.rate(t), at(t)) - (at(t + h) - at(t - h)) / (2 * h)).norm(), 0,
                    1e-8);
        EXPECT_LE(point_velocity(vessel, pose, path.rate(t), at(t)).norm(), motion_bounds(vessel).speed * (1 + 1e-12));
      }
      EXPECT_NEAR(spin_3d(vessel, pose, path.rate(t)).norm(), std::abs(path.rate(t).turn_rate), 1e-15);
    }
    // x towards z: seen along y its spin is negative.
    EXPECT_LT(spin_3d(vessel, path.pose(0.5), path.rate(0.5)).y(), -2.9);
    EXPECT_GE(motion_bounds(vessel).speed, 3 * 0.25);
    EXPECT_NEAR(motion_bounds(vessel).vertical_acceleration, std::sin(tilt) * motion_bounds(vessel).acceleration,
                1e-15);
  }
}

TEST(Motion, UnderADrumALineLiesBelowAllThatItReaches) {
  Vessel vessel = moving(TurningMotion{{0.1, 0.05}, 3});
  vessel.box = false;
  WallPiece circle;
  circle.centre = {0.1, 0.05}, circle.radius = 0.2, circle.to = 2 * std::numbers::pi;
  vessel.pieces = {circle};
  const Pose below = line_below(vessel).value();
  const Eigen::Vector2d axis = in_lab_frame(vessel, {}, {0.1, 0.05});
  const double height = in_lab_frame(vessel, below, {0.3, 0}).y();
  EXPECT_NEAR(in_lab_frame(vessel, below, {-0.3, 0}).y(), height, 1e-15) << "level";
  EXPECT_LE(height, axis.y() - 0.2);
  EXPECT_GT(height, axis.y() - 0.5);
  EXPECT_FALSE(line_below(moving(RockingMotion{{0.1, 0}, 0.1, 3})));
  EXPECT_FALSE(line_below(moving(TurningMotion{{0.1, 0.05}, 3, TurningAxis::upright})));
}

TEST(Motion, ATableIsMetAtItsTimesAndHeldOutside) {
  const TableMotion table = sampled_sine();
  const VesselPath path(moving(table));
  for (std::size_t k = 0; k < table.times.size(); ++k) {
    const Pose pose = path.pose(table.times[k]);
    EXPECT_NEAR(pose.displacement.x(), table.x[k], 1e-15);
    EXPECT_NEAR(pose.displacement.y(), table.y[k], 1e-15);
    EXPECT_NEAR(pose.angle, table.angle[k], 1e-15);
  }
  EXPECT_NEAR(path.pose(0).displacement.x(), table.x.front(), 1e-15);
  EXPECT_NEAR(path.pose(9).angle, table.angle.back(), 1e-15);
  // Between the times the sine is met to the order of the interpolation.
  EXPECT_NEAR(path.pose(0.35625).displacement.x(), 2e-3 * std::sin(20 * 0.35625), 1e-6);
}

TEST(Motion, BoundsAreReachedAndNotPassed) {
  for (const Kind& kind : every_kind()) {
    const Vessel vessel = moving(kind.motion);
    const VesselPath path(vessel);
    const double length = vessel.length, height = vessel.height;
    double speed = 0, acceleration = 0, vertical = 0, aside = 0, turned = 0;
    const double h = 1e-5;
    // Between the ramps, whose fraction the bounds leave out; of the table all of it, for it is jerked to rest at its
    // ends.
    const bool whole = std::holds_alternative<TableMotion>(kind.motion);
    for (double t = whole ? 0.1002 : 0.21; t < (whole ? 0.5998 : 0.39); t += 1e-4)
      for (const Eigen::Vector2d& own :
           {Eigen::Vector2d(0, 0), Eigen::Vector2d(length, 0), Eigen::Vector2d(length, height)}) {
        const auto at = [&](double time) { return in_lab_frame(vessel, path.pose(time), own); };
        const Eigen::Vector2d a = (at(t + h) - 2 * at(t) + at(t - h)) / (h * h);
        speed = std::max(speed, ((at(t + h) - at(t - h)) / (2 * h)).norm());
        acceleration = std::max(acceleration, a.norm());
        vertical = std::max(vertical, std::abs(a.y()));
        aside = std::max(aside, std::abs(at(t).x() - in_lab_frame(vessel, {}, own).x()));
        turned = std::max(turned, std::abs(std::remainder(path.pose(t).angle, 2 * std::numbers::pi)));
      }
    EXPECT_LE(speed, motion_bounds(vessel).speed * 1.001) << kind.name;
    EXPECT_LE(acceleration, motion_bounds(vessel).acceleration * 1.02) << kind.name;
    EXPECT_LE(vertical, motion_bounds(vessel).vertical_acceleration * 1.02) << kind.name;
    EXPECT_LE(aside, motion_bounds(vessel).displacement * 1.001) << kind.name;
    EXPECT_GE(aside, 0.2 * motion_bounds(vessel).displacement) << kind.name;
    EXPECT_LE(turned, motion_bounds(vessel).angle * 1.001) << kind.name;
    EXPECT_GE(speed, 0.5 * motion_bounds(vessel).speed) << kind.name;
    EXPECT_GE(acceleration, 0.3 * motion_bounds(vessel).acceleration) << kind.name;
  }
  EXPECT_EQ(motion_bounds(Vessel{}).speed, 0);
  EXPECT_EQ(motion_bounds(moving(HarmonicMotion{0, 0.01, 9, 0})).vertical_acceleration, 0);
  EXPECT_LT(motion_bounds(moving(HarmonicMotion{std::numbers::pi / 2, 0.01, 9, 0})).displacement, 1e-12);
}

TEST(Motion, AGrainLyingOnARockingFloorFeelsTheFloorsOwnVelocity) {
  // The floor turns about its left end; its material under a grain 0.4 m away moves up with 0.4 omega. A grain that
  // moves along with it feels no damping: the force is that of a floor at rest.
  Bench bench;
  bench.scene.contact.wall = {0.4, 0.5};
  const double angle = 0.01, frequency = 5, along = 0.4, overlap = 1e-6;
  bench.scene.tray.motion = RockingMotion{{0, 0}, angle, frequency, 0};
  const double spin = angle * 2 * std::numbers::pi * frequency;
  const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  const double height = Bench::radius - overlap;
  bench.place(along, height, -spin * height, spin * along, spin);
  EXPECT_NEAR(bench.start(1e-9).field().forces()[0].fy, stiffness * overlap, 1e-6 * stiffness * overlap);
  EXPECT_NEAR(bench.start(1e-9).field().forces()[0].fx, 0, 1e-6 * stiffness * overlap);
  bench.scene.tray.motion.reset();
  EXPECT_GT(std::abs(bench.start(1e-9).field().forces()[0].fy - stiffness * overlap), 0.1 * stiffness * overlap)
      << "against a floor at rest it is damped";
}

/// A wall and how a grain stands at it: a point of it and the direction out of it, in the vessel's frame.
struct Standing {
  Eigen::Vector3d point, out;
};

Eigen::Vector3d torque_on(const Simulation& run, std::size_t i) {
  if (!run.grains().is_3d) return {0, 0, run.field().forces()[i].torque};
  const GrainVector& torque = run.field().torques_3d()[i];
  return {torque.x, torque.y, torque.z};
}

/// A grain that goes along with a vessel's material is pushed as by a vessel at rest: neither damped nor rubbed
/// nor turned.
void expect_pushed_as_at_rest(Space space, const VesselMotion& motion, const Standing& standing) {
  Bench bench(space);
  bench.scene.contact.seed = bench.scene.contact.wall = {
      .friction = 0.4, .restitution = 0.5, .rolling_friction = 0.1, .twisting_friction = 0.1};
  bench.scene.contact.rolling = Rolling::constant_torque;
  bench.scene.contact.slip_speed = 1e-3;
  Vessel& tray = bench.scene.tray;
  tray.origin = {0.3, 0.7}, tray.front = 0.2, tray.motion = motion;
  tray.pieces = {{{0.2, 0.6}, {0.8, 0.6}}};  // a shelf
  const double overlap = 1e-6, stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  const VesselPath path(tray);
  const Pose pose = path.pose(0);
  const PoseRate rate = path.rate(0);
  const Eigen::Vector3d at = point_in_lab(tray, pose, standing.point + (Bench::radius - overlap) * standing.out);
  const Eigen::Vector3d velocity = point_velocity(tray, pose, rate, at), spin = spin_3d(tray, pose, rate);
  const Eigen::Vector3d expected = stiffness * overlap * direction_in_lab(tray, pose, standing.out);
  bench.place(at, velocity, spin);
  EXPECT_LT((force_on(bench.start(1e-9), 0) - expected).norm(), 1e-6 * expected.norm());
  EXPECT_LT(torque_on(bench.start(1e-9), 0).norm(), 1e-6 * Bench::radius * expected.norm());
  tray.motion.reset();
  EXPECT_GT((force_on(bench.start(1e-9), 0) - expected).norm(), 0.1 * expected.norm()) << "as against one at rest";
}

TEST(Motion, AGrainThatGoesAlongWithAnyWallOfATurningVesselIsPushedAsAtRest) {
  const Eigen::Vector3d right(1, 0, 0), up(0, 1, 0), back(0, 0, 1);
  for (const Space space : both_spaces) {
    std::vector<Standing> walls = {{{0.7, 0, 0.6}, up},
                                   {{0.4, 0.6, 0.3}, up},
                                   {{0.4, 0.6, 0.3}, -up},
                                   {{0, 0.8, 0.4}, right},
                                   {{1, 0.3, 0.4}, -right}};
    if (space == Space::three_dimensional) walls.insert(walls.end(), {{{0.7, 0.3, 0}, back}, {{0.3, 0.8, 1}, -back}});
    for (std::size_t k = 0; k < walls.size(); ++k) {
      SCOPED_TRACE(testing::Message() << (space == Space::two_dimensional ? "plane" : "space") << ", wall " << k);
      expect_pushed_as_at_rest(space, RockingMotion{{0.1, -0.2}, 0.05, 5}, walls[k]);
      expect_pushed_as_at_rest(space, TurningMotion{{0.1, -0.2}, 2}, walls[k]);
      if (space == Space::three_dimensional)
        expect_pushed_as_at_rest(space, TurningMotion{{0.1, -0.2}, 2, TurningAxis::upright}, walls[k]);
    }
  }
}

TEST(Motion, WorkOfARockingFloorIsAccountedFor) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.motion = RockingMotion{{0.3, 0.02}, 0.01, 8, 0.05};
  for (int k = 0; k < 10; ++k) bench.place(0.1 + 0.08 * k, (1.5 + 0.3 * k) * Bench::radius);
  Simulation& run = bench.start(bench.contact_time() / 200);
  const double before = kinetic_energy(run.grains()) + potential_energy(run.grains(), bench.gravity);
  run.steps(100000);
  const vibrosow::Run result = run.result();
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  ASSERT_GT(std::abs(result.energy.wall_work), 1e-5);
  const double account = result.energy.kinetic + result.energy.potential + result.energy.elastic - before;
  EXPECT_NEAR(account, result.energy.wall_work, 0.01 * std::abs(result.energy.wall_work));
}

TEST(Motion, GrainsFallThroughTheHolesOfARockingTrayAndNowhereElse) {
  Scene scene = Bench().scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 1.0}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.length = 0.2;
  scene.tray.height = 0.1;
  scene.tray.holes = {{0.05, 0.03}, {0.15, 0.03}};
  scene.tray.fill = Fill{150, Packing::poured, 1e-3, false};
  scene.tray.motion = RockingMotion{{0.1, 0}, 0.1, 4, 0.1};
  scene.run.duration = 0.5;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
  EXPECT_GT(run.balance.counted, 50);
  EXPECT_EQ(run.balance.lost, 0);
}

}  // namespace
}  // namespace vibrosow
