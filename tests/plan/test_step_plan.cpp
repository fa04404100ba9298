#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "grains/size_distribution.hpp"
#include "laws/restitution.hpp"
#include "plan/model.hpp"
#include "plan/touching_kinds.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "support/solid_clumps.hpp"

namespace vibrosow {
namespace {

/// Paper A's fig. 3 without its hopper: 39 layers of 8 mm grains, eps = 0.01 r, 9 Hz, 1 cm.
Scene published() {
  Scene scene = Bench().scene;
  scene.contact.shell_compression = 0.01;
  scene.contact.seed.friction = scene.contact.wall.friction = 0.3;
  scene.tray.length = 0.5;
  scene.tray.fill = Fill{2400, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.numerics.integrator = Integrator::rk2_midpoint;
  scene.run.duration = 2;
  return scene;
}

const StepLimit& limit(const StepPlan& plan, const char* part_of_reason) {
  for (const StepLimit& l : plan.limits)
    if (l.reason.find(part_of_reason) != std::string::npos) return l;
  throw std::runtime_error("no such limit");
}

TEST(StepPlan, ContactLastsHalfAPeriodOfTheShell) {
  EXPECT_NEAR(prepare(published()).step.contact_duration, 6.34e-3, 0.01e-3);
}

TEST(StepPlan, ResolvesTheMotionOfEitherVessel) {
  const auto plan_of = [](const VesselMotion& motion, bool of_hopper) {
    Scene scene = published();
    scene.tray.motion.reset();
    scene.hopper = scene.tray;
    scene.hopper->name = "hopper", scene.hopper->origin = {0, 1.2};
    (of_hopper ? *scene.hopper : scene.tray).motion = motion;
    return prepare(scene).step;
  };
  const double speed = 2 * Bench::pi * 6000;
  TableMotion table;
  for (int k = 0; k <= 400; ++k) {
    const double time = k / (40 * 6000.0);
    table.times.push_back(time), table.x.push_back(1e-6 * std::sin(speed * time)), table.y.push_back(0);
    table.angle.push_back(0);
  }
  SumMotion sum;
  sum.components = {{0, 0.01, 9}, {1, 1e-6, 6000}, {0, 0, 1e5}};
  for (const bool of_hopper : {false, true}) {
    for (const VesselMotion& motion :
         std::initializer_list<VesselMotion>{HarmonicMotion{0, 1e-6, 6000}, HarmonicMotion{1, 1e-6, 6000, 0.1, 1}, sum,
                                             RockingMotion{{0, 0}, 1e-6, 6000}, TurningMotion{{0, 0}, -speed}, table}) {
      const StepPlan plan = plan_of(motion, of_hopper);
      EXPECT_NEAR(limit(plan, "period").dt * 20 * 6000, 1, std::holds_alternative<TableMotion>(motion) ? 0.02 : 1e-12)
          << motion.index();
      EXPECT_LE(plan.dt, limit(plan, "period").dt);
    }
    EXPECT_THROW(limit(plan_of(HarmonicMotion{0, 0, 9}, of_hopper), "period"), std::runtime_error) << "nothing moves";
  }
}

TEST(StepPlan, ADriveFasterThanTheContactsRulesTheStep) {
  Scene scene = published();
  scene.numerics.integrator = Integrator::velocity_verlet;
  const StepPlan slow = prepare(scene).step;
  scene.tray.motion = HarmonicMotion{0, 1e-7, 6000, 0};
  const StepPlan fast = prepare(scene).step;
  EXPECT_EQ(fast.bound_by, "20 steps in a period of the motion");
  EXPECT_DOUBLE_EQ(fast.dt, 1.0 / 6000 / 20);
  EXPECT_GT(slow.dt, fast.dt);
  scene.numerics.dt = 1.2e-5;
  const StepPlan by_hand = prepare(scene).step;
  EXPECT_TRUE(by_hand.too_long);
  EXPECT_TRUE(step_refused(scene.numerics, by_hand));
  scene.numerics.allow_long_step = true;
  EXPECT_FALSE(step_refused(scene.numerics, by_hand));
}

TEST(StepPlan, LimitsAreThoseOfTheEquations) {
  Scene scene = published();
  // RK2: omega_max = 858 1/s, growth ln(1.01) / 2 s without drag: 4.2e-5 s.
  EXPECT_NEAR(limit(prepare(scene).step, "RK2").dt, 4.2e-5, 0.05e-5);
  // Verlet: 2 / omega_max with room to spare, and what a bed less dense than hexagonal allows.
  scene.numerics.integrator = Integrator::velocity_verlet;
  EXPECT_GT(limit(prepare(scene).step, "Verlet").dt, 0.75 * 2 / 858);
  EXPECT_LE(limit(prepare(scene).step, "Verlet").dt, 1.005 * std::sqrt(0.9) * 2 / 858);
  // Friction in the bed: lambda = nu F_n 6 / (m v_s), 38 layers on the lowest pair.
  const double rate = 0.3 * 38 * standard_gravity * 6 / 0.02;
  EXPECT_NEAR(limit(prepare(scene).step, "friction").dt, 2 / rate, 1e-9);
}

TEST(StepPlan, DampingShortensTheStepOfEveryScheme) {
  Scene scene = published();
  scene.contact.seed = scene.contact.wall = {0, 0.2};
  const double omega = std::sqrt(3 * standard_gravity / (0.01 * Bench::radius));
  const double zeta = std::sqrt(3.0) * linear_damping_ratio(0.2);  // the bed's, of the pair's
  scene.numerics.integrator = Integrator::velocity_verlet;
  const double verlet = limit(prepare(scene).step, "Verlet").dt;
  EXPECT_GT(verlet, 0.3 * 1.5 / omega) << "each contact takes its own change into account";
  EXPECT_LT(verlet, 0.9 * 1.5 / omega);
  scene.numerics.integrator = Integrator::rk2_midpoint;
  const double midpoint = (std::sqrt(1 + zeta * zeta) - zeta) / omega;
  EXPECT_NEAR(limit(prepare(scene).step, "RK2").dt, midpoint, 1e-9 * midpoint);
  scene.numerics.integrator = Integrator::gear5;
  EXPECT_NEAR(limit(prepare(scene).step, "Gear").dt, 0.081 / zeta / omega, 1e-9 / omega);
  scene.contact.seed = scene.contact.wall = {0, 1};
  EXPECT_NEAR(limit(prepare(scene).step, "Gear").dt, 0.327 / omega, 1e-9 / omega);
}

TEST(StepPlan, SpinsOnSpringsVibrateAtTheirFrequency) {
  // All discs turning alike: omega^2 = 2 x rho k / m, x = 6 m r^2 / I = 12, k = m g / (2 eps).
  Scene scene = published();
  scene.contact.friction_model = FrictionModel::spring;
  const double omega = std::sqrt(12 * 14.0 / 17 * standard_gravity / (0.01 * Bench::radius));
  scene.numerics.integrator = Integrator::gear5;
  EXPECT_NEAR(limit(prepare(scene).step, "spin").dt, 0.327 / omega, 1e-9 / omega);
  scene.numerics.integrator = Integrator::velocity_verlet;
  EXPECT_LE(limit(prepare(scene).step, "bed").dt, 1.005 * std::sqrt(0.9) * 2 / omega);
}

TEST(PredictedOverlap, OfABedShakenUpGoesWithItsWeight) {
  Scene scene = published();
  const double at_rest = prepare(scene).overlap.overlap_at_rest;
  scene.tray.motion = HarmonicMotion{std::numbers::pi / 2, 0.01, 9, 0};
  const double acceleration = 0.01 * std::pow(2 * std::numbers::pi * 9, 2);
  EXPECT_NEAR(prepare(scene).overlap.overlap_at_rest / at_rest, 1 + acceleration / standard_gravity, 1e-9);
}

TEST(StepPlan, SmallestSeedOfALotSetsTheStep) {
  // A disc of half the diameter at equal density and eps / r: omega^2 = 6 k / m with k = c_s c_l / (c_s + c_l), where
  // c = m g / eps grows as the size; the stiffest is the smallest among largest.
  Scene scene = published();
  scene.numerics.integrator = Integrator::gear5;
  const double single = limit(prepare(scene).step, "Gear").dt;
  scene.lots[0].sizes = {SizeDistribution::Kind::uniform, 8e-3, 0, 4e-3, 12e-3, {}, {}};
  const double stiffness = 0.5 * 1.5 / (0.5 + 1.5), mass = 0.25;  // over c and m of the mean seed; 1/2 and 1 for equals
  EXPECT_NEAR(limit(prepare(scene).step, "Gear").dt, single * std::sqrt(mass * 0.5 / stiffness), 1e-12);
  scene.numerics.integrator = Integrator::rk2_midpoint;
  // Friction: lambda grows with F_n / m, E[s^2] s / s^2 of the mean seed's.
  EXPECT_NEAR(limit(prepare(published()).step, "friction").dt / limit(prepare(scene).step, "friction").dt,
              (1 + 0.25 / 3) / 0.5, 1e-9);
  EXPECT_NEAR(limit(prepare(scene).step, "travel").dt, 0.5 * limit(prepare(published()).step, "travel").dt, 1e-15);
}

TEST(StepPlan, SofterShellsAllowLongerSteps) {
  Scene scene = published();
  scene.contact.seed.friction = scene.contact.wall.friction = 0;
  for (const auto& [integrator, factor] :
       {std::pair{Integrator::velocity_verlet, std::sqrt(2.0)}, std::pair{Integrator::rk2_midpoint, std::cbrt(4.0)}}) {
    scene.numerics.integrator = integrator;
    scene.contact.shell_compression = 0.001;
    const double stiff = prepare(scene).step.limits.front().dt;
    scene.contact.shell_compression = 0.002;
    EXPECT_NEAR(prepare(scene).step.limits.front().dt / stiff, factor, 0.01);
  }
}

TEST(StepPlan, ChosenStepIsSafe) {
  Scene scene = published();
  for (const double compression : {1e-5, 1e-4, 1e-2})
    for (const double restitution : {0.05, 0.5, 1.0})
      for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint}) {
        scene.contact.shell_compression = compression;
        scene.contact.seed.restitution = scene.contact.wall.restitution = restitution;
        scene.numerics.integrator = integrator;
        EXPECT_FALSE(prepare(scene).step.too_long);
      }
}

TEST(StepPlan, PublishedStepIsTooLongAndSaysWhyAndWhatIsSafe) {
  Scene scene = published();
  scene.numerics.dt = 0.002;
  const StepPlan plan = prepare(scene).step;
  EXPECT_TRUE(plan.too_long);
  try {
    simulate(scene);
    FAIL() << "must be refused";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("0.002"), std::string::npos) << message;
    EXPECT_NE(message.find(plan.bound_by), std::string::npos) << message;
    EXPECT_NE(message.find("4.1"), std::string::npos) << message;  // the longest safe step, 4.19e-5 s
  }
}

TEST(StepPlan, ForetellsOverlapAtRestAndAtImpact) {
  const PredictedOverlap predicted = prepare(published()).overlap;
  EXPECT_EQ(predicted.layers, 39);
  EXPECT_NEAR(predicted.pair_overlap_at_rest, 0.78, 1e-9);
  EXPECT_NEAR(predicted.impact_speed, 2 * 0.565, 2e-3);
  // At V = 2 A omega, 5 % needs eps/r = 0.0025 g r / V^2 = 7.7e-5.
  Scene scene = published();
  scene.contact.shell_compression = 7.7e-5;
  EXPECT_NEAR(prepare(scene).overlap.overlap_at_impact, 0.05, 0.0005);
  EXPECT_NEAR(prepare(published()).overlap.stiff_enough, 7.7e-5, 0.1e-5);
  scene.tray.motion.reset();  // then the weight of 39 layers decides
  EXPECT_NEAR(prepare(scene).overlap.stiff_enough, 0.05 / 39, 1e-9);
}

TEST(StepPlan, AClumpYieldsMoreAtItsTipAndIsStiffOnItsSide) {
  // A dipole of two discs that touch: gyration^2 = r^2 / 2 + r^2, arm r: 1 + 2/3 at its tip, 2 on its side.
  Scene scene = Bench().scene;
  SeedLot& lot = scene.lots.front();
  const double r = 0.25 * lot.diameter;
  lot.shape = Shape::clump;
  lot.gyration2 = 1.5 * r * r;
  lot.discs = {{0, 0, r}, {0, 0, r}};
  scene.numerics.integrator = Integrator::gear5;
  const StepPlan centred = prepare(scene).step;
  const double tip = limit(centred, "the shell's").dt, side = limit(centred, "flat sides").dt;
  lot.discs = {{-r, 0, r}, {r, 0, r}};
  EXPECT_NEAR(limit(prepare(scene).step, "the shell's").dt, tip / std::sqrt(5.0 / 3), 1e-9 * tip);
  EXPECT_NEAR(limit(prepare(scene).step, "flat sides").dt, side / std::sqrt(2.0), 1e-9 * side);
}

TEST(StepPlan, AClumpInSpaceIsNoStifferThanItsArmsMakeIt) {
  // A dipole of two balls that touch: 2/5 r^2 about its axis and r^2 more across.
  const double r = 2e-3;
  const SeedLot lot = solid_lot(dipole(2 * r, 2 * r), 1e-4);
  SeedLot centred = lot;
  centred.discs = {{0, 0, r}, {0, 0, r}};
  Scene scene = clump_scene(lot);
  scene.contact.seed = scene.contact.wall = {0.3, 1};
  scene.contact.friction_model = FrictionModel::spring;
  scene.numerics.integrator = Integrator::gear5;
  const StepPlan plan = prepare(scene).step;
  scene.lots = {centred};
  const StepPlan short_arms = prepare(scene).step;
  const double tip = 1 + 1 / 1.4;
  EXPECT_NEAR(limit(plan, "the shell's").dt, limit(short_arms, "the shell's").dt / std::sqrt(tip), 1e-9 * plan.dt);
  // Both balls of a side turn about the axis: 2 r^2 / (2/5 r^2); one at its furthest point, (1 / sqrt(1.4) +
  // sqrt(2.5))^2. Balls in one place, which make no side, count as one: r^2 / (2/5 r^2).
  const double turning = std::pow(1 / std::sqrt(1.4) + std::sqrt(2.5), 2);
  EXPECT_GT(turning, 5);
  EXPECT_NEAR(limit(plan, "spin").dt, limit(short_arms, "spin").dt * std::sqrt(2.5 / turning), 1e-9 * plan.dt);
}

/// Impacts on the floor, tip first and on a flat side, frictionless and elastic: the contact of a clump is the faster
/// the more its point yields, and never faster than the plan's.
TEST(StepPlan, NoImpactOfAClumpInSpaceIsFasterThanPlanned) {
  const SeedLot lot = solid_lot(odd_balls(), 1e-3);
  Scene scene = clump_scene(lot);
  scene.numerics.integrator = Integrator::gear5;
  const StepPlan plan = prepare(scene).step;
  scene.numerics.integrator = Integrator::velocity_verlet;
  const Model planned = prepare(scene);
  // omega^2 = 8 s k / m is the bed's, k between equal shells being half that on a wall: a wall's contact has 2 s k / m.
  const double bed = 0.327 / limit(plan, "the shell's").dt;
  const double shortest = std::numbers::pi / (bed / 2);
  Model model = with_step(planned, 1e-7);
  model.gravity = {0, 0};
  Random random(3);
  double least = 1;
  for (int k = 0; k < 60; ++k) {
    const Orientation q = draw_orientation(random);
    double lowest = 0;
    for (const ClumpDisc& ball : lot.discs)
      lowest = std::min(lowest, (rotation_matrix(q) * centre_of(ball)).y() - ball.radius);
    Simulation run(model, start_of(model, {{{0.5, 1e-7 - lowest, 0.5}, {0, -0.01, 0}, {0, 0, 0}, q}}));
    std::int64_t touched = 0, apart = 0;
    while (apart < 10 && run.time() < 0.02) {
      ASSERT_TRUE(run.step());
      const bool pushed = run.field().forces_3d()[0].y > 0;
      touched += pushed, apart = touched > 0 && !pushed ? apart + 1 : 0;
    }
    ASSERT_GT(touched, 100);
    least = std::min(least, static_cast<double>(touched) * 1e-7);
  }
  EXPECT_GT(least, shortest);
  EXPECT_LT(least, 2 * shortest) << "the plan is not far off";
}

/// A heap of grains, shaken, at the longest step that the plan allows: whatever law, damping and scheme, the numerics
/// make no energy worth stopping for.
TEST(StepPlan, EverySchemeIsSoundAtItsLongestSafeStep) {
  for (const Law law : {Law::elastic_shell, Law::hertz, Law::hertz_viscous})
    for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
      for (const double restitution : {0.2, 0.8})
        for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring}) {
          Scene scene = Bench().scene;
          scene.contact.law = law;
          scene.contact.youngs_modulus = 1e7;
          scene.contact.poisson_ratio = 0.2;
          const bool viscous = law == Law::hertz_viscous;
          scene.contact.damping_rate = viscous ? (restitution < 0.5 ? 4000 : 300) : 0;
          scene.contact.seed = scene.contact.wall = {0.3, viscous ? 1.0 : restitution};
          scene.contact.friction_model = model;
          scene.tray.length = 0.1;
          scene.tray.height = 0.3;
          scene.tray.fill = Fill{60, Packing::hexagonal, 1e-3, false};
          scene.tray.motion = HarmonicMotion{std::numbers::pi / 2, 3e-3, 15, 0.05};
          scene.numerics.integrator = integrator;
          scene.run.duration = 0.5;
          scene.numerics.dt = prepare(scene).step.longest_safe * (1 - 1e-9);
          const vibrosow::Run run = simulate(scene);
          EXPECT_EQ(run.status, RunStatus::finished)
              << run.stop_reason << "; law " << static_cast<int>(law) << ", scheme " << static_cast<int>(integrator)
              << ", restitution " << restitution << ", model " << static_cast<int>(model);
          EXPECT_EQ(run.balance.inside, 60);
        }
}

/// What laws foretell, from their own force: by energy, by its inverse, by a difference.
TEST(Laws, ForetellImpactsAndRest) {
  const double stiffness[] = {1.5e4, 2e6}, mass = 3e-4, speed = 0.7, force = 0.02;  // N/m and N/m^(3/2)
  const double powers[] = {1, 1.5};
  for (const Law law : {Law::elastic_shell, Law::hertz, Law::hertz_viscous}) {
    const LawTraits& traits = traits_of(law);
    const bool shell = law == Law::elastic_shell;
    const double k = stiffness[shell ? 0 : 1], power = powers[shell ? 0 : 1];
    const double deepest = std::pow((power + 1) * 0.5 * mass * speed * speed / k, 1 / (power + 1));
    EXPECT_NEAR(traits.impact_overlap(k, 1 / mass, speed), deepest, 1e-9 * deepest);
    const double duration = shell ? std::numbers::pi * std::sqrt(mass / k) : HertzImpact(mass, k, speed).duration;
    EXPECT_NEAR(traits.impact_duration(k, 1 / mass, speed), duration, 1e-6 * duration);
    const double rest = traits.static_overlap(k, force), h = 1e-4 * rest;
    EXPECT_NEAR(k * std::pow(rest, power), force, 1e-9 * force);
    const double slope = k * (std::pow(rest + h, power) - std::pow(rest - h, power)) / (2 * h);
    EXPECT_NEAR(traits.slope(k, rest), slope, 1e-6 * slope);
    EXPECT_NEAR(traits.slope_over_secant, slope * rest / force, 1e-6);
    // A dashpot c on a pair that vibrates: c / (2 m omega).
    const SurfaceParameters surface{.damping_ratio = 0.3, .damping_rate = 400};
    EXPECT_NEAR(traits.damping_ratio(surface, 5000), law == Law::hertz_viscous ? 400.0 / (2 * 5000) : 0.3, 1e-12);
  }
}

TEST(TouchingKinds, OneSizeTheSmallestAndTheLargestAtEqualDensity) {
  Scene scene = Bench().scene;
  scene.lots = {{"scattered", 4e-3, 4e-5, Shape::ball, 0.5}, {"single", 4e-3, 4e-5, Shape::disc, 0.5}};
  scene.lots[0].sizes = {SizeDistribution::Kind::uniform, 4e-3, 0, 2e-3, 6e-3, {}, {}};
  scene.contact.seed.friction = 0.3;  // turns them
  const Model model = prepare(scene);
  const std::vector<GrainKind> kinds = touching_kinds(scene.lots, sizes_of(scene.lots), model.kinds, *model.law);
  ASSERT_EQ(kinds.size(), 4u);
  EXPECT_EQ(kinds[0].radius, 2e-3);
  EXPECT_DOUBLE_EQ(kinds[1].radius, 1e-3);
  EXPECT_DOUBLE_EQ(kinds[2].radius, 3e-3);
  EXPECT_DOUBLE_EQ(kinds[1].mass, 4e-5 / 8);
  EXPECT_DOUBLE_EQ(kinds[2].mass, 4e-5 * 27 / 8);
  EXPECT_DOUBLE_EQ(1 / kinds[1].inverse_inertia, 0.4 * kinds[1].mass * 1e-6);
}

TEST(PredictedOverlap, OfASeedThatRainsOnTheFloorIsThatOfTheRun) {
  Scene scene = Bench().scene;  // nothing moves, no fill, no damping
  scene.tray.rain = Rain{.rate = 4, .from = 0.5, .to = 0.5, .height = 0.3, .start = 0, .stop = 0.3};
  scene.run.duration = 0.6;
  const PredictedOverlap predicted = prepare(scene).overlap;
  EXPECT_NEAR(predicted.impact_speed, std::sqrt(2 * standard_gravity * 0.3), 1e-9);
  EXPECT_NEAR(simulate(scene).max_relative_overlap / predicted.overlap_at_impact, 1, 0.02);
}

TEST(PredictedOverlap, CountsTheFallFromAHopperAndThroughAHole) {
  Scene scene = published();
  scene.hopper = scene.tray;
  scene.hopper->motion.reset();
  scene.hopper->origin = {0, 0.36};
  scene.hopper->holes = {{0.25, 0.04, 0}};
  EXPECT_NEAR(prepare(scene).overlap.impact_speed, std::sqrt(2 * standard_gravity * 0.36), 1e-9);
  scene.hopper.reset();
  scene.tray.motion.reset();
  scene.tray.holes = {{0.25, 0.08, 0}};
  EXPECT_NEAR(prepare(scene).overlap.impact_speed, std::sqrt(2 * standard_gravity * 0.08), 1e-9);
}

}  // namespace
}  // namespace vibrosow
