// A run that is changed while it goes on: no jump in how the tray moves, no seed lost or left in a wall, counts that
// begin anew.
#include "simulation/live_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "simulation/guard.hpp"
#include "simulation/state_check.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

Scene changing_tray() {
  Scene scene;
  scene.lots = {{"a", 6e-3, 2e-4, Shape::ball, 1.0}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.4, 0.5, 0.1, 0};
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.rolling = Rolling::spring;
  scene.tray.name = "tray";
  scene.tray.length = 0.24, scene.tray.height = 0.2;
  scene.tray.holes = {{0.06, 0.02}, {0.18, 0.02}};
  scene.tray.fill = Fill{120, Packing::layers, 1e-3, true};
  scene.tray.motion = HarmonicMotion{0.1, 5e-3, 9, 0.05};
  scene.run.duration = 0.5;
  scene.run.measure_from = 0.1;
  return scene;
}

HarmonicMotion& shake_of(Scene& scene) {
  return std::get<HarmonicMotion>(*scene.tray.motion);
}

void step_until(LiveRun& run, double time) {
  while (run.simulation().time() < time) ASSERT_TRUE(run.step());
}

/// Until it no longer waits.
void step_to_change(LiveRun& run) {
  while (run.is_waiting()) ASSERT_TRUE(run.step());
}

double energy_of_all(Simulation& run) {
  return kinetic_energy(run.grains()) + potential_energy(run.grains(), run.model().gravity) +
         run.field().elastic_energy();
}

std::set<std::int64_t> all_ids(const Simulation& run) {
  std::set<std::int64_t> ids(run.grains().id.begin(), run.grains().id.end());
  for (const OutflowEvent& event : run.events_since(0)) ids.insert(event.grain);
  return ids;
}

double deepest_in_walls(const Simulation& run) {
  double deepest = 0;
  for (std::size_t wall = 0; wall < run.field().walls().count(); ++wall)
    for (std::size_t i = 0; i < run.grains().size(); ++i) {
      const double radius = run.grains().kind(i).radius;
      deepest = std::max(deepest, 1 - std::sqrt(run.field().walls().distance2(wall, run.grains().place(i))) / radius);
    }
  return deepest;
}

/// The fastest and the hardest that a tray is driven from one time to another, by differences.
struct Driven {
  double speed = 0, acceleration = 0;
};
Driven most_driven(const Vessel& tray, double from, double to) {
  const double h = 1e-5;
  Driven most;
  for (double t = from + h; t < to; t += h) {
    const Eigen::Vector2d before = vessel_pose(tray, t - h).displacement, now = vessel_pose(tray, t).displacement,
                          next = vessel_pose(tray, t + h).displacement;
    most.speed = std::max(most.speed, (next - now).norm() / h);
    most.acceleration = std::max(most.acceleration, (next - 2 * now + before).norm() / (h * h));
  }
  return most;
}

TEST(MotionChange, HasNoJumpAndDrivesHardlyHarderThanEitherMotion) {
  const HarmonicMotion slow{0, 5e-3, 9, 0.05};
  for (const HarmonicMotion& other : {HarmonicMotion{0, 12e-3, 9, 0.05}, HarmonicMotion{0, 5e-3, 14, 0.05},
                                      HarmonicMotion{0.7, 3e-3, 5, 0.05}, HarmonicMotion{0, 0, 9, 0.05}})
    for (const double time : {0.02, 0.2, 0.2278, 0.25}) {
      const MotionChange change = change_motion(slow, other, time);
      Vessel tray, before, after;
      tray.motion = change.course, before.motion = slow, after.motion = change.after;
      for (const double t : {0.0, 0.5 * time, time}) {
        EXPECT_NEAR((vessel_pose(tray, t).displacement - vessel_pose(before, t).displacement).norm(), 0, 1e-15);
        EXPECT_NEAR((vessel_velocity(tray, t).velocity - vessel_velocity(before, t).velocity).norm(), 0, 1e-12);
      }
      for (const double t : {change.until, change.until + 0.123}) {
        EXPECT_NEAR((vessel_pose(tray, t).displacement - vessel_pose(after, t).displacement).norm(), 0, 1e-15);
        EXPECT_NEAR((vessel_velocity(tray, t).velocity - vessel_velocity(after, t).velocity).norm(), 0, 1e-12);
      }
      const auto bound = [&](int power) {
        const auto of = [power](const HarmonicMotion& m) {
          return m.amplitude * std::pow(2 * std::numbers::pi * m.frequency, power);
        };
        return std::max(of(slow), of(other));
      };
      const Driven most = most_driven(tray, std::max(0.1, time - 0.01), change.until + 0.01);
      EXPECT_LE(most.speed, 1.15 * bound(1)) << other.amplitude << " at " << other.frequency << " Hz from " << time;
      EXPECT_LE(most.acceleration, 1.3 * bound(2)) << other.amplitude << " at " << other.frequency << " Hz";
    }
}

TEST(LiveRun, GoesOnToTheLastBitWhereNothingChanges) {
  const Model model = prepare_to_run(changing_tray());
  Simulation run(model, 5);
  ASSERT_TRUE(run.run_until(0.15));
  const SimulationState state = carried_over(run, model);
  EXPECT_TRUE(is_possible(model, starting_state(model, 5, no_grains(model)), state));
  Simulation next(model, state);
  ASSERT_TRUE(run.run_until(0.2));
  ASSERT_TRUE(next.run_until(0.2));
  EXPECT_EQ(run.grains().x, next.grains().x);
  EXPECT_EQ(run.grains().vy, next.grains().vy);
  EXPECT_EQ(run.grains().omega, next.grains().omega);
  EXPECT_LT(next.events_since(0).size(), run.events_since(0).size()) << "it counts anew";
}

TEST(LiveRun, IsThePlainRunUntilItIsChanged) {
  const Scene scene = changing_tray();
  LiveRun live(scene, 3);
  EXPECT_FALSE(live.change(scene));
  Simulation plain(prepare_to_run(scene), 3);
  step_until(live, 0.1);
  ASSERT_TRUE(plain.run_until(0.1));
  EXPECT_EQ(plain.grains().x, live.simulation().grains().x);
  EXPECT_EQ(live.changes(), 0);
}

TEST(LiveRun, EnergyDoesNotJumpWhenTheShakeChanges) {
  Scene scene = changing_tray();
  LiveRun run(scene, 1);
  step_until(run, 0.15);
  shake_of(scene).amplitude = 10e-3, shake_of(scene).frequency = 6;
  ASSERT_FALSE(run.change(scene));
  const double before = energy_of_all(run.simulation()), time = run.simulation().time();
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.changes(), 1);
  EXPECT_EQ(run.waiting(), LiveRun::Waiting::for_nothing);
  EXPECT_NEAR(run.since(), time, 1e-12);
  const double moved = kinetic_energy(run.simulation().grains());
  EXPECT_NEAR(energy_of_all(run.simulation()), before, 0.01 * moved);
  step_until(run, 0.4);
  const auto result = run.simulation().result();
  EXPECT_TRUE(result.stop_reason.empty()) << result.stop_reason;
  EXPECT_LT(result.energy.made_by_numerics, 0.01 * result.energy.kinetic);
  EXPECT_EQ(result.balance.lost, 0);
}

TEST(LiveRun, AnotherShakeBeginsOnceTheOneBeforeHasSetIn) {
  Scene scene = changing_tray();
  LiveRun run(scene, 1);
  step_until(run, 0.1);
  shake_of(scene).amplitude = 7e-3;
  ASSERT_FALSE(run.change(scene));
  ASSERT_TRUE(run.step());
  shake_of(scene).amplitude = 8e-3;
  ASSERT_FALSE(run.change(scene));
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.waiting(), LiveRun::Waiting::for_motion);
  step_to_change(run);
  EXPECT_EQ(run.changes(), 2);
  EXPECT_NEAR(run.since(), 0.1 + 1.0 / 9, 1e-3);
}

TEST(LiveRun, AHoleMovesAtAStrokesEndAndLosesNoSeed) {
  for (const double shift : {2e-3, -5e-3, 40e-3}) {
    Scene scene = changing_tray();
    LiveRun run(scene, 1);
    step_until(run, 0.12);
    scene.tray.holes[0].centre += shift;
    scene.tray.holes[0].width = 0.018;
    ASSERT_FALSE(run.change(scene));
    std::set<std::int64_t> ids;
    double before = 0;
    while (run.is_waiting()) {
      ids = all_ids(run.simulation()), before = energy_of_all(run.simulation());
      ASSERT_TRUE(run.step());
    }
    ASSERT_EQ(run.waiting(), LiveRun::Waiting::for_nothing) << "given up, by " << shift;
    EXPECT_GE(run.changes(), shift > 30e-3 ? 2 : 1) << "far: in steps";
    const Simulation& now = run.simulation();
    EXPECT_EQ(now.model().scene.tray.holes[0].centre, scene.tray.holes[0].centre);
    const double fastest = 2 * std::numbers::pi * 9 * 5e-3;
    EXPECT_LT(now.field().walls().rate(0, run.since()).velocity.norm(), 0.01 * fastest);
    EXPECT_NEAR(energy_of_all(run.simulation()), before, 0.02 * kinetic_energy(now.grains()));
    const double warned = now.model().scene.guard.warn_relative_overlap;
    EXPECT_LT(deepest_in_walls(now), warned);
    const std::size_t kept = now.grains().size();
    EXPECT_GE(ids.size(), kept);
    step_until(run, run.since() + 0.2);
    const auto result = run.simulation().result();
    EXPECT_TRUE(result.stop_reason.empty()) << result.stop_reason;
    EXPECT_EQ(result.balance.lost, 0);
    EXPECT_EQ(result.balance.put_in, result.balance.inside + result.balance.counted + result.balance.spilled);
    EXPECT_GT(result.events.size(), 0u);
    for (const OutflowEvent& event : result.events) {
      EXPECT_GT(event.time, run.since());
    }
  }
}

TEST(LiveRun, HolesWidenAtTheNextStrokesEnd) {
  Scene scene = changing_tray();
  LiveRun run(scene, 1);
  step_until(run, 0.12);
  for (Hole& hole : scene.tray.holes) hole.width = 0.03;
  ASSERT_FALSE(run.change(scene));
  step_to_change(run);
  EXPECT_EQ(run.changes(), 1) << "both at once";
  EXPECT_LT(run.since(), 0.12 + 0.5 / 9 + 1e-3);
}

TEST(LiveRun, AHoleWhoseFloorASeedIsInTheWayOfStaysAndThatIsSaid) {
  Scene scene = changing_tray();
  scene.tray.motion = HarmonicMotion{0, 1e-4, 12, 0};
  scene.tray.fill = Fill{60, Packing::layers, 0, false};
  scene.tray.holes = {{0.06, 5e-3}};         // a seed of 6 mm lies in it
  scene.guard.warn_relative_overlap = 1e-4;  // and must not be pressed
  scene.run.duration = 4;
  LiveRun run(scene, 1);
  step_until(run, 0.5);
  const std::size_t seeds = run.simulation().grains().size();
  scene.tray.holes[0].centre += 3e-3;
  ASSERT_FALSE(run.change(scene));
  step_to_change(run);
  EXPECT_EQ(run.waiting(), LiveRun::Waiting::given_up);
  EXPECT_NEAR(run.simulation().time(), 0.5 + 10.0 / 12, 0.01);
  EXPECT_EQ(run.changes(), 0);
  EXPECT_EQ(run.simulation().grains().size(), seeds);
}

TEST(LiveRun, CountsAndMeasuresAnewAfterAChange) {
  Scene scene = changing_tray();
  LiveRun run(scene, 1);
  step_until(run, 0.3);
  ASSERT_GT(run.simulation().events_since(0).size(), 0u);
  shake_of(scene).amplitude = 6e-3;
  ASSERT_FALSE(run.change(scene));
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.simulation().events_since(0).size(), 0u);
  const Scene& now = run.simulation().model().scene;
  EXPECT_NEAR(now.run.measure_from, run.since() + 0.1, 1e-12);
  EXPECT_NEAR(now.run.duration, run.since() + 0.5, 1e-12);
  EXPECT_EQ(run.simulation().result().tray_at_begin, -1);
}

TEST(LiveRun, AShorterStepLetsAWholeNumberOfStepsHavePassed) {
  Scene scene = changing_tray();
  scene.contact.friction_model = FrictionModel::sliding;  // whose step goes with the seeds' weight
  scene.contact.shell_compression = 1e-2;
  shake_of(scene).direction = std::numbers::pi / 2;
  shake_of(scene).amplitude = 1e-3;
  LiveRun run(scene, 1);
  step_until(run, 0.2);
  const double had = run.simulation().model().step.dt, time = run.simulation().time();
  shake_of(scene).amplitude = 6e-3, shake_of(scene).frequency = 15;
  ASSERT_FALSE(run.change(scene));
  ASSERT_TRUE(run.step());
  const Simulation& now = run.simulation();
  ASSERT_LT(now.model().step.dt, had);
  EXPECT_LE(now.model().step.dt, prepare_to_run(scene).step.dt);
  EXPECT_NEAR(run.since(), time, 1e-12);
  EXPECT_EQ(now.time(), static_cast<double>(now.state().step) * now.model().step.dt);
  step_until(run, 0.4);
  EXPECT_FALSE(run.simulation().guard().stop_reason());
}

TEST(LiveRun, SaysWhatItCannotGoOnWith) {
  const Scene scene = changing_tray();
  LiveRun run(scene, 1);
  const auto obstacle = [&](const auto& edit) {
    Scene wanted = scene;
    edit(wanted);
    return run.change(wanted);
  };
  EXPECT_EQ(obstacle([](Scene& s) { s.lots[0].diameter = 5e-3; }), Obstacle::seeds);
  EXPECT_EQ(obstacle([](Scene& s) { s.contact.wall.friction = 0.3; }), Obstacle::seeds);
  EXPECT_EQ(obstacle([](Scene& s) { s.numerics.accuracy = AccuracyLevel::design; }), Obstacle::accuracy);
  EXPECT_EQ(obstacle([](Scene& s) { s.tray.holes.pop_back(); }), Obstacle::holes);
  EXPECT_EQ(obstacle([](Scene& s) { s.tray.holes[0].centre = 0.01; }), Obstacle::holes) << "no floor is left of it";
  EXPECT_EQ(obstacle([](Scene& s) { s.tray.holes[0].open_at = 0.1; }), Obstacle::vessels);
  EXPECT_EQ(obstacle([](Scene& s) { s.tray.length = 0.25; }), Obstacle::vessels);
  EXPECT_EQ(obstacle([](Scene& s) { s.tray.motion = RockingMotion{{0.1, 0}, 0.01, 9}; }), Obstacle::motion);
  EXPECT_EQ(obstacle([](Scene& s) { shake_of(s).ramp = 0.2; }), Obstacle::motion);
  EXPECT_EQ(obstacle([](Scene& s) { shake_of(s).stop = 1; }), Obstacle::motion);
  EXPECT_EQ(obstacle([](Scene& s) { s.run.duration = 2; }), Obstacle::plan);
  EXPECT_EQ(run.waiting(), LiveRun::Waiting::for_nothing);
  EXPECT_EQ(name_of(Obstacle::stiffness), "stiffness");
}

TEST(LiveRun, SeedsOfALevelStayAsSoftAsTheyAreUnlessTheShakeNeedsStifferOnes) {
  Scene scene = changing_tray();
  scene.numerics.accuracy = AccuracyLevel::draft;
  LiveRun run(scene, 1);
  const double softness = run.simulation().model().scene.contact.shell_compression;
  shake_of(scene).amplitude = 7e-3;
  EXPECT_FALSE(run.change(scene));
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.simulation().model().scene.contact.shell_compression, softness);
  shake_of(scene).amplitude = 0.1;
  shake_of(scene).frequency = 20;
  EXPECT_EQ(run.change(scene), Obstacle::stiffness);
}

}  // namespace
}  // namespace vibrosow
