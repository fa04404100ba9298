// Cases that break a discrete-element code: each must stay bounded, be refused with a reason, or be stopped with one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plan/step_plan.hpp"
#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

constexpr double up = std::numbers::pi / 2;

double total_energy(Simulation& run, const Eigen::Vector2d& gravity) {
  return kinetic_energy(run.grains()) + potential_energy(run.grains(), gravity) + run.field().elastic_energy();
}

/// Relative change of energy in one elastic impact at z = omega dt: under both schemes the kink at touch and parting
/// gives up to 0.23 z^2 of either sign, and RK2 a mean gain of (pi / 4) z^3 on top.
double largest_change(Integrator integrator, double z) {
  const double kink = 0.23 * z * z, gain = std::numbers::pi / 4 * z * z * z;
  return integrator == Integrator::velocity_verlet ? kink : kink + gain;
}

Scene tray_scene(int grains, double length) {
  Scene scene = Bench().scene;
  scene.tray.length = length;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.tray.fill = Fill{grains, Packing::hexagonal, 1e-3, false};
  return scene;
}

void expect_sound(const vibrosow::Run& run) {
  EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
  EXPECT_EQ(run.balance.lost, 0);
  EXPECT_EQ(run.balance.spilled, 0);
  EXPECT_EQ(run.balance.put_in, run.balance.inside + run.balance.counted);
  EXPECT_TRUE(std::isfinite(run.energy.kinetic));
}

TEST(Stability, TallBedShakenVerticallyAtThreeG) {
  Scene scene = tray_scene(400, 0.085);  // 38 layers
  const double omega = 2 * std::numbers::pi * 20;
  scene.tray.motion = HarmonicMotion{up, 3 * standard_gravity / (omega * omega), 20, 0.1};
  scene.run.duration = 1;
  const vibrosow::Run run = simulate(scene);
  expect_sound(run);
  EXPECT_LT(run.max_relative_overlap, 0.2);
  EXPECT_LT(run.energy.made_by_numerics, 0.01 * run.energy.wall_work);
}

TEST(Stability, SixtyHertzAtTwentyG) {
  Scene scene = tray_scene(60, 0.085);
  scene.contact.shell_compression = 1e-5;
  const double omega = 2 * std::numbers::pi * 60;
  scene.tray.motion = HarmonicMotion{up, 20 * standard_gravity / (omega * omega), 60, 0};
  scene.run.duration = 0.3;
  expect_sound(simulate(scene));
}

TEST(Stability, HeavyGrainsOnLightOnesAtOneToThousand) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.length = 0.04;
  bench.scene.contact.shell_compression = 2e-5;  // 1:1000 needs 5e-5 or less
  bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
  bench.scene.lots.push_back({"heavy", 2 * Bench::radius, 1000 * Bench::mass, Shape::disc, 0.5});
  for (int k = 0; k < 12; ++k) bench.place(0.0041 + 0.0089 * (k % 4), 0.0041 + 0.0083 * (k / 4));
  for (int k = 0; k < 4; ++k) bench.place(0.0042 + 0.0088 * k, 0.0300, 0, 0, 0, 1);
  Simulation& run = bench.start(prepare(bench.scene).step.dt);
  const double before = total_energy(run, bench.gravity);
  while (run.time() < 0.5) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double half_way = total_energy(run, bench.gravity);
  while (run.time() < 2) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double end = total_energy(run, bench.gravity);
  EXPECT_LT(half_way, before);
  EXPECT_LT(end, half_way);
  EXPECT_EQ(run.result().balance.inside, 16);
  EXPECT_LT(run.result().max_relative_overlap, 0.2);
  // In play: the fall of the heavy row.
  EXPECT_LT(run.result().energy.made_by_numerics, 0.01 * (before - end));
}

class EveryScheme : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Schemes, EveryScheme, testing::Values(Integrator::velocity_verlet, Integrator::rk2_midpoint),
                         [](const auto& name) { return name.param == Integrator::rk2_midpoint ? "rk2" : "verlet"; });

struct Changes {
  double largest = 0, mean = 0;  // of energy, relative, in one throw
};

/// Throws an elastic grain at something many times.
template <class Aim>
Changes throw_at(Integrator integrator, int throws, Aim aim) {
  Changes changes;
  for (int k = 0; k < throws; ++k) {
    Bench bench;
    bench.scene.numerics.integrator = integrator;
    aim(bench, k);
    Simulation& run = bench.start(bench.contact_time() / 20);
    const double before = total_energy(run, bench.gravity);
    while (run.statistics().contacts == 0 && run.time() < 1) run.step();
    EXPECT_GT(run.statistics().contacts, 0);
    for (std::int64_t seen = -1; seen != run.statistics().contacts;) {
      seen = run.statistics().contacts;
      run.steps(3);
    }
    const double change = total_energy(run, bench.gravity) / before - 1;
    changes.largest = std::max(changes.largest, std::abs(change));
    changes.mean += change / throws;
  }
  return changes;
}

constexpr double z = std::numbers::pi / 20;  // omega dt of one shell on a wall, at 20 steps a contact
constexpr double mean_gain_rk2 = std::numbers::pi / 4 * z * z * z;

TEST_P(EveryScheme, GrainOnAHolesEdgeKeepsItsEnergy) {
  const Changes changes = throw_at(GetParam(), 400, [](Bench& bench, int k) {
    bench.scene.tray.holes = {{0.5, 0.1}};
    // From head-on to grazing on the left edge at (0.45, 0).
    const double aside = -0.2 * Bench::radius + (1.19 * Bench::radius) * k / 400;
    bench.place(0.45 + aside, 0.02, 0, -0.2);
  });
  EXPECT_LE(changes.largest, largest_change(GetParam(), z));
  EXPECT_LE(std::abs(changes.mean), mean_gain_rk2);
}

TEST_P(EveryScheme, GrainInACornerKeepsItsEnergy) {
  const Changes changes = throw_at(GetParam(), 400, [](Bench& bench, int k) {
    const double angle = 0.05 + 1.45 * k / 400;
    bench.place(0.02, 0.02, -0.3 * std::cos(angle), -0.3 * std::sin(angle));
  });
  // One impact on the floor and one on the wall share the energy.
  EXPECT_LE(changes.largest, largest_change(GetParam(), z));
  EXPECT_LE(std::abs(changes.mean), mean_gain_rk2);
}

TEST(Stability, ElasticGasDriftsByNoMoreThanARandomWalkOfItsImpacts) {
  Bench bench;
  bench.scene.tray.length = 0.1;
  for (int k = 0; k < 64; ++k)
    bench.place(0.006 + 0.0125 * (k % 8), 0.006 + 0.0115 * (k / 8), 0.3 * std::sin(1.7 * k),
                -0.3 * std::cos(2.3 * k) * (k % 2));
  bench.gravity = {0, -standard_gravity};  // the box has no lid: its walls are 1 m high
  Simulation& run = bench.start(bench.contact_time() / 20);
  const double before = total_energy(run, bench.gravity);
  run.steps(300000);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_NEAR(total_energy(run, bench.gravity) / before, 1, 0.05);
  EXPECT_EQ(run.result().balance.inside, 64);
}

TEST(Stability, CoincidentCentresPartWithoutAnyNotANumber) {
  Bench bench;
  bench.scene.guard.stop_relative_overlap = 100;
  bench.scene.guard.energy_tolerance = 1e9;
  bench.scene.contact.seed = {0.3, 0.5};
  bench.place(0.5, 0.5).place(0.5, 0.5);
  Simulation& run = bench.start(bench.contact_time() / 50);
  run.steps(500);
  const Grains& g = run.grains();
  ASSERT_EQ(g.size(), 2u);
  EXPECT_TRUE(std::isfinite(g.x[0] + g.y[0] + g.x[1] + g.y[1]));
  EXPECT_GT(std::hypot(g.x[1] - g.x[0], g.y[1] - g.y[0]), 2 * Bench::radius);
}

TEST(Stability, CoincidentCentresStopAnOrdinaryRun) {
  Bench bench;
  bench.place(0.5, 0.5).place(0.5, 0.5);
  Simulation& run = bench.start(bench.contact_time() / 50);
  EXPECT_FALSE(run.step());
  EXPECT_NE(run.guard().stop_reason()->find("relative overlap"), std::string::npos);
}

TEST(Stability, OverlappingStartIsRefused) {
  Scene scene = tray_scene(200, 0.1);
  Vessel hopper = scene.tray;
  hopper.name = "hopper";
  hopper.origin = {0, 0.03};  // in the midst of the tray's bed
  hopper.height = 0.4;
  scene.hopper = hopper;
  scene.run.duration = 0.01;
  try {
    simulate(scene);
    FAIL() << "must be refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("overlap"), std::string::npos) << error.what();
  }
}

// Regularised friction creeps: a pile spreads at about the slip speed times its load, but its kinetic energy dies and
// nothing leaps. The tall step and walls keep this one in place.
TEST(Stability, PileComesToRest) {
  Scene scene = tray_scene(150, 0.12);
  scene.tray.fill->packing = Packing::poured;
  scene.run.duration = 1;
  Simulation run(prepare(scene), 1);
  while (run.time() < 1) ASSERT_TRUE(run.step());
  const double per_grain = kinetic_energy(run.grains()) / 150;
  EXPECT_LT(per_grain, 1e-8 * Bench::mass * standard_gravity * Bench::radius);
  const std::vector<double> x = run.grains().x, y = run.grains().y;
  while (run.time() < 1.5) ASSERT_TRUE(run.step());
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_LT(std::hypot(run.grains().x[i] - x[i], run.grains().y[i] - y[i]), 0.01 * Bench::radius) << i;
}

TEST(Stability, StepTooLongForTheShellIsRefusedAndInsistedOnIsStopped) {
  Scene scene = tray_scene(100, 0.1);
  scene.contact.seed = scene.contact.wall = {0, 1};
  scene.numerics.dt = 1.2 * prepare(scene).step.contact_duration;
  scene.run.duration = 0.5;
  EXPECT_THROW(simulate(scene), InputError);
  scene.numerics.allow_long_step = true;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::stopped_by_guard);
  EXPECT_FALSE(run.stop_reason.empty());
  EXPECT_TRUE(run.outside_the_model);
}

TEST(Stability, EnergyGuardStopsAStepThatMakesEnergy) {
  // Midpoint RK2 at z = 1 multiplies a free vibration by 1.11 each step; shells far from the guard's limit.
  Scene scene = tray_scene(30, 0.085);
  scene.contact.seed = scene.contact.wall = {0, 1};
  scene.numerics.integrator = Integrator::rk2_midpoint;
  scene.numerics.dt = 0.99 * prepare(scene).step.contact_duration / std::numbers::pi;
  scene.numerics.allow_long_step = true;
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 0.5;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::stopped_by_guard);
  EXPECT_NE(run.stop_reason.find("numerics made"), std::string::npos) << run.stop_reason;
}

TEST(Stability, StepTooLongForFrictionIsRefusedWithTheLongestAllowed) {
  Scene scene = tray_scene(400, 0.085);
  scene.contact.slip_speed = 1e-3;
  scene.numerics.dt = 2e-5;
  scene.run.duration = 0.1;
  const StepPlan plan = prepare(scene).step;
  EXPECT_TRUE(plan.too_long);
  EXPECT_EQ(plan.bound_by, "friction below the slip speed");
  EXPECT_THROW(simulate(scene), InputError);
}

TEST(Stability, GrainThatCouldCrossAWallInOneStepIsStoppedNotLost) {
  for (const double speed : {60.0, 500.0, 1e6}) {
    Bench bench;
    bench.place(0.5, 0.02, 0, -speed);
    Simulation& run = bench.start(1e-4);
    run.steps(10);
    ASSERT_TRUE(run.guard().stop_reason());
    EXPECT_EQ(run.result().balance.lost, 0);
    EXPECT_EQ(run.result().balance.inside, 1);
  }
}

TEST(Stability, DeepHitOnAWallIsStoppedBeforeTheCentreIsThrough) {
  Bench bench;
  bench.scene.contact.shell_compression = 0.1;
  bench.place(0.5, 0.02, 0, -3);
  Simulation& run = bench.start(1e-5);
  run.steps(2000);
  ASSERT_TRUE(run.guard().stop_reason());
  EXPECT_GT(run.grains().y[0], 0);
  EXPECT_EQ(run.result().balance.lost, 0);
}

TEST(Stability, NotANumberIsStopped) {
  Bench bench;
  bench.place(0.5, 0.5, 0, 0);
  Simulation& run = bench.start(1e-5);
  run.grains().vx[0] = std::nan("");
  run.steps(10);
  EXPECT_TRUE(run.guard().stop_reason());
}

/// 200 balls of 4 mm that rest in a box 10 cm wide, with the step that is chosen for them.
Scene damped_bed() {
  Scene scene;
  scene.lots = {{"ball", 4e-3, 40e-6, Shape::ball, 1}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.seed = scene.contact.wall = {1.0, 0.1};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.name = "tray";
  scene.tray.length = 0.1, scene.tray.height = 0.2;
  scene.tray.fill = Fill{200, Packing::poured, 0, false};
  scene.run.duration = 0.5;
  return scene;
}

TEST(StrongDamping, ABedAtRestFallsSilent) {
  for (const Integrator scheme : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
    for (const double ratio : {2.0 / 7, 14.0 / 17}) {
      Scene scene = damped_bed();
      scene.numerics.integrator = scheme;
      scene.contact.tangential_ratio = ratio;
      Simulation run(prepare(scene), 1);
      while (run.time() < 0.3) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
      EXPECT_LT(kinetic_energy(run.grains()) / 200, 1e-9 * 40e-6 * standard_gravity * 2e-3) << static_cast<int>(scheme);
    }
}

/// Whether a bed gets to `end` (s); what still moves then only creeps, as friction below its slip speed lets it.
void expect_only_creep(const Scene& scene, double end) {
  Simulation run(prepare(scene), 1);
  while (run.time() < end) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  EXPECT_GT(run.statistics().slip_raised, 0) << "no hard impact: nothing was tried";
  const double mass = run.model().kinds.front().mass * static_cast<double>(run.grains().size());
  EXPECT_LT(std::sqrt(2 * kinetic_energy(run.grains()) / mass), scene.contact.slip_speed);
}

TEST(StrongDamping, ABedThatSlidesComesToRest) {
  for (const Integrator scheme : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
    for (const double rolling : {0.0, 0.1}) {
      SCOPED_TRACE(testing::Message() << "scheme " << static_cast<int>(scheme) << ", rolling friction " << rolling);
      Scene scene = damped_bed();
      scene.numerics.integrator = scheme;
      scene.contact.friction_model = FrictionModel::sliding;
      scene.contact.rolling = Rolling::constant_torque;
      scene.contact.seed.rolling_friction = scene.contact.wall.rolling_friction = rolling;
      expect_only_creep(scene, 0.3);
    }
}

/// Forty discs of 2 mm in a rod of 2 cm: many of them touch at once when it lies flat, on the floor or another rod.
TEST(StrongDamping, RodsOfFortyDiscsThatSlideComeToRest) {
  Scene scene = damped_bed();
  std::vector<ClumpDisc> rod;
  for (int k = 0; k < 40; ++k) rod.push_back({0.5e-3 * (k - 19.5), 0, 1e-3});
  SeedLot lot{"rod", 2 * holding_radius(rod), 40e-6, Shape::clump, 1};
  lot.gyration2 = plate_of(rod).gyration2;
  lot.discs = rod;
  scene.lots = {lot};
  scene.tray.fill->count = 12;
  scene.contact.friction_model = FrictionModel::sliding;
  expect_only_creep(scene, 0.05);
}

TEST(StrongDamping, HertzWithFrictionTwoFallsSilent) {
  Scene scene = damped_bed();
  scene.contact.law = Law::hertz;
  scene.contact.youngs_modulus = 1e7;
  scene.contact.seed = scene.contact.wall = {2.0, 0.05};
  Simulation run(prepare(scene), 1);
  while (run.time() < 0.3) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  EXPECT_LT(kinetic_energy(run.grains()) / 200, 1e-9 * 40e-6 * standard_gravity * 2e-3);
}

}  // namespace
}  // namespace vibrosow
