// The tangential spring and its memory.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/friction.hpp"
#include "grains/random.hpp"
#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow {
namespace {

/// A grain at rest on the floor under its weight, with a tangential spring and without damping.
struct StuckGrain {
  Law law;
  Shape shape;

  static constexpr double modulus = 1e8, poisson = 0.3;

  double gyration() const { return shape == Shape::ball ? 0.4 : 0.5; }
  double hertz_stiffness() const { return 4.0 / 3 * modulus / (1 - poisson * poisson) * std::sqrt(Bench::radius); }
  double overlap() const {
    return law == Law::hertz ? std::pow(Bench::mass * standard_gravity / hertz_stiffness(), 2.0 / 3)
                             : 1e-4 * Bench::radius;
  }
  /// Of the tangential spring, N/m: Mindlin's 8 G* sqrt(R d) on a rigid wall, or 14/17 of the shell's m g / eps.
  double stiffness() const {
    const double shear = modulus / (2 * (1 + poisson)) / (2 - poisson);
    return law == Law::hertz ? 8 * shear * std::sqrt(Bench::radius * overlap())
                             : 14.0 / 17 * Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  }
  double arm() const { return Bench::radius - overlap(); }
  /// sqrt(k_t (1/m + a^2/I)), rad/s
  double frequency() const {
    const double inertia = gyration() * Bench::mass * Bench::radius * Bench::radius;
    return std::sqrt(stiffness() * (1 / Bench::mass + arm() * arm() / inertia));
  }
  Bench bench() const {
    Bench b;
    b.gravity = {0, -standard_gravity};
    b.scene.lots[0].shape = shape;
    b.scene.contact.law = law;
    b.scene.contact.youngs_modulus = modulus;
    b.scene.contact.wall.friction = 0.5;
    b.scene.contact.friction_model = FrictionModel::spring;
    return b;
  }
};

double energy(Simulation& run) {
  return kinetic_energy(run.grains()) + run.field().elastic_energy();
}

// A grain that is pushed a little swings on its tangential spring. Without any damping its energy changes by no more
// than the midpoint scheme's (omega dt)^4 / 4 a step, and wavers by (omega dt)^2 within a swing.
TEST(TangentialSpring, StuckGrainSwingsAtItsFrequency) {
  VerificationReport report(
      "spring_frequency", "a grain stuck to the floor swings on its tangential spring, 100 swings",
      {"law", "shape", "integrator", "frequency_theory_rad_per_s", "frequency_rad_per_s", "deviation_percent",
       "energy_change_over_swing_energy", "largest_energy_change_over_swing_energy", "scheme_bound"});
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Shape shape : {Shape::disc, Shape::ball})
      for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5}) {
        const StuckGrain grain{law, shape};
        Bench bench = grain.bench();
        bench.scene.numerics.integrator = integrator;
        const double omega = grain.frequency(), limit = 0.5 * Bench::mass * standard_gravity;
        const double push = 0.1 * limit / grain.stiffness() * omega;  // a tenth of what friction holds
        bench.place(0.5, grain.arm(), push);
        const int per_swing = 200, swings = 100;
        const double dt = 2 * Bench::pi / omega / per_swing;
        Simulation& run = bench.start(dt);
        const double at_rest = energy(run) - kinetic_energy(run.grains());
        const double swing = limit * limit * 0.01 / (2 * grain.stiffness());  // J, of the spring at its longest
        const double first = energy(run) - at_rest;
        double largest = 0, before = push, began = 0, ended = 0;
        int crossings = 0;
        while (crossings < 2 * swings) {
          ASSERT_TRUE(run.step());
          largest = std::max(largest, std::abs(energy(run) - at_rest - first) / swing);
          const double sliding = run.grains().vx[0] + grain.arm() * run.grains().omega[0];
          if (before * sliding < 0) {
            ended = run.time() - dt * sliding / (sliding - before);
            if (++crossings == 1) began = ended;
          }
          before = sliding;
        }
        const double measured = Bench::pi * (crossings - 1) / (ended - began);
        const double z = omega * dt;
        const std::string scheme = integrator == Integrator::gear5          ? "gear5"
                                   : integrator == Integrator::rk2_midpoint ? "rk2-midpoint"
                                                                            : "velocity-verlet";
        EXPECT_NEAR(measured, omega, 0.001 * omega) << scheme;
        const double bound = swings * per_swing * z * z * z * z / 4 + z * z;
        EXPECT_LT(largest, bound) << scheme;
        report.add(law == Law::hertz ? "hertz" : "elastic_shell", shape == Shape::ball ? "ball" : "disc", scheme, omega,
                   measured, 100 * (measured / omega - 1), (energy(run) - at_rest - first) / swing, largest, bound);
      }
}

// Gross sliding: friction is mu N, and the spring is kept at the length that holds just that.
TEST(TangentialSpring, IsLimitedByCoulombAndShortened) {
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const double damping : {0.0, 0.5}) {
      const StuckGrain grain{law, Shape::ball};
      Bench bench = grain.bench();
      bench.scene.contact.wall.restitution = 0.5;
      bench.scene.contact.tangential_damping = damping;
      bench.place(0.1, grain.arm(), 0.5);
      Simulation& run = bench.start(1e-6);
      run.steps(1000);
      for (int k = 0; k < 100; ++k) {
        ASSERT_TRUE(run.step());
        const Forces& f = run.field().forces();
        ASSERT_NEAR(-f[0].fx, 0.5 * f[0].fy, 1e-12 * f[0].fy);
        const double slip = run.state().contacts.wall_histories.slip[0];
        ASSERT_NEAR(slip, 0.5 * f[0].fy / grain.stiffness(), 1e-3 * slip);
      }
    }
}

// An oblique elastic impact without any damping gains nothing. The shell's tangential stiffness is constant: where the
// contact sticks, next to nothing is lost either. Mindlin's falls with the overlap while the displacement stands: the
// total-displacement form (the one behind Chung & Ooi's test 4) loses a part even where nothing slips, as reported.
TEST(TangentialSpring, ObliqueImpactGainsNoEnergy) {
  VerificationReport report(
      "oblique_energy",
      "oblique elastic impact of a ball on a wall with a tangential spring and no damping: kinetic "
      "energy after over before",
      {"law", "friction", "incident_angle_deg", "energy_after_over_before"});
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const double friction : {0.1, 0.3, 10.0})
      for (double degrees = 5; degrees <= 85; degrees += 5) {
        Bench bench = StuckGrain{law, Shape::ball}.bench();
        bench.gravity = {0, 0};
        bench.scene.guard.energy_tolerance = 10;
        bench.scene.contact.wall.friction = friction;
        // With 2/7 a ball's tangential spring is slack again when the contact opens: nothing is lost where it sticks.
        if (law == Law::elastic_shell) bench.scene.contact.tangential_ratio = 2.0 / 7;
        const double speed = 0.1, angle = degrees * Bench::pi / 180, down = speed * std::cos(angle);
        const double contact =
            law == Law::hertz ? HertzImpact(Bench::mass, StuckGrain{law, Shape::ball}.hertz_stiffness(), down).duration
                              : bench.contact_time();
        const ImpactResult i = wall_impact(bench, down, speed * std::sin(angle), contact / 1000);
        const double spin = 0.4 * Bench::radius * Bench::radius * i.omega * i.omega;
        const double left = (i.vx * i.vx + i.vy * i.vy + spin) / (speed * speed);
        EXPECT_LT(left, 1 + 1e-6) << degrees;
        if (law == Law::elastic_shell && friction == 10) {
          EXPECT_GT(left, 1 - 1e-5) << degrees;
        }
        report.add(law == Law::hertz ? "hertz" : "elastic_shell", friction, degrees, left);
      }
}

// Whatever the speeds, spring and dashpot together never give back more than was put in.
TEST(TangentialSpring, NeverMakesEnergy) {
  Random random(5);
  for (int history = 0; history < 200; ++history) {
    const double stiffness = 100, limit = 1, dashpot = random.uniform(0, 20), dt = 1e-4;
    double displacement = 0, work = 0, speed = 0;
    for (int step = 0; step < 2000; ++step) {
      if (step % 20 == 0) speed = random.uniform(-2, 2);
      const double before = displacement;
      displacement += speed * dt;
      const double moved = displacement - before;
      const double force = spring_friction(stiffness, dashpot, limit, speed, 0.0, displacement);
      work += force * moved;
      ASSERT_LE(std::abs(force), limit);
      // The force at the end of a step stands for the whole: k (dx)^2 / 2 too much work a step at most.
      ASSERT_LE(0.5 * stiffness * displacement * displacement, work + 1e-12);
    }
  }
}

// Where the limit has fallen below what the spring held, the shortened spring counts beside the dashpot.
TEST(TangentialSpring, HoldsNoMoreThanItsLimitBesideTheDashpot) {
  const double stiffness = 100, limit = 1, dashpot = 2, speed = -0.1;
  double displacement = 0.03;
  EXPECT_DOUBLE_EQ(spring_friction(stiffness, dashpot, limit, speed, 0.0, displacement), limit + dashpot * speed);
  EXPECT_DOUBLE_EQ(displacement, limit / stiffness);
}

// After the parting nothing is remembered, and the next impact is what a first one would be.
TEST(TangentialSpring, ForgetsAtSeparation) {
  const auto first_impact = [](double vx, double vy, double omega) {
    Bench bench = StuckGrain{Law::hertz, Shape::ball}.bench();
    bench.scene.contact.wall.restitution = 0.8;
    return wall_impact(bench, -vy, vx, 2e-7, omega);
  };
  const ImpactResult once = first_impact(0.1, -0.3, 20);
  Bench bench = StuckGrain{Law::hertz, Shape::ball}.bench();
  bench.scene.contact.wall.restitution = 0.8;
  bench.scene.guard.energy_tolerance = 10;  // energy is put in by hand below
  const double dt = 2e-7;
  bench.place(0.5, Bench::radius + 2.37 * 0.3 * dt, 0.1, -0.3, 20);
  Simulation& run = bench.start(dt);
  double longest = 0;
  while (run.grains().vy[0] <= 0 || run.grains().y[0] < Bench::radius) {
    ASSERT_TRUE(run.step());
    longest = std::max(longest, std::abs(run.state().contacts.wall_histories.slip[0]));
  }
  EXPECT_GT(longest, 1e-8);
  run.step();
  EXPECT_EQ(run.state().contacts.wall_histories.slip[0], 0);
  EXPECT_NEAR(run.grains().vx[0], once.vx, 1e-12);
  // Sent down again as the first time, after a contact that left the spring stretched: the same impact to the last
  // bits.
  Grains& g = run.grains();
  g.vx[0] = 0.1, g.vy[0] = -0.3, g.omega[0] = 20;
  g.x[0] = 0.5, g.y[0] = Bench::radius + 2.37 * 0.3 * dt;
  run.step();
  while (run.grains().vy[0] <= 0 || run.grains().y[0] < Bench::radius) ASSERT_TRUE(run.step());
  EXPECT_NEAR(run.grains().vx[0], once.vx, 1e-9);
  EXPECT_NEAR(run.grains().omega[0], once.omega, 1e-6);
}

/// A shaken tray with everything that contacts remember.
Scene remembering_scene() {
  Scene scene;
  scene.lots = {{"big", 8e-3, 6e-4, Shape::ball, 0.6}, {"small", 5e-3, 1.5e-4, Shape::ball, 0.4}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.4, 0.6, 0.1};
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.rolling = Rolling::spring;
  scene.tray.name = "tray";
  scene.tray.length = 0.15;
  scene.tray.height = 0.1;
  scene.tray.holes = {{0.075, 0.03}};
  scene.tray.fill = Fill{120, Packing::poured, 1e-3, true};
  scene.tray.motion = HarmonicMotion{0.3, 5e-3, 12, 0};
  scene.run.duration = 1;
  return scene;
}

// The lists are renewed at other times, or at every step: not a bit changes.
TEST(TangentialSpring, MemorySurvivesEveryRenewalOfTheLists) {
  const Scene scene = remembering_scene();
  const auto run = [&](NeighbourMargins margins, Integrator integrator) {
    Scene own = scene;
    own.numerics.integrator = integrator;
    auto simulation =
        std::make_unique<Simulation>(with_step(prepare(own), 5e-5), 3, ComputeOptions{.margins = margins});
    simulation->steps(4000);
    return simulation;
  };
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint}) {
    const auto usual = run({}, integrator);
    double remembered = 0;
    for (const double slip : usual->state().contacts.pair_histories.slip) remembered += std::abs(slip);
    ASSERT_GT(remembered, 1e-6);
    for (const NeighbourMargins margins : {NeighbourMargins{0.5, 0.02}, NeighbourMargins{0.02, 0.002}}) {
      const auto other = run(margins, integrator);
      ASSERT_FALSE(other->guard().stop_reason());
      ASSERT_NE(other->field().neighbours().prunes(), usual->field().neighbours().prunes());
      ASSERT_EQ(other->grains().size(), usual->grains().size());
      for (std::size_t i = 0; i < usual->grains().size(); ++i) {
        ASSERT_EQ(other->grains().x[i], usual->grains().x[i]) << i;
        ASSERT_EQ(other->grains().vy[i], usual->grains().vy[i]) << i;
        ASSERT_EQ(other->grains().omega[i], usual->grains().omega[i]) << i;
      }
    }
  }
}

// Which grain is first is a matter of names: an oblique impact of two polydisperse grains, both ways, to the bit.
TEST(TangentialSpring, SwappingTheGrainsChangesNothing) {
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Rolling rolling : {Rolling::none, Rolling::constant_torque, Rolling::spring})
      for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring}) {
        const auto impact = [&](bool swapped) {
          Bench bench;
          bench.scene.lots.push_back({"heavy", 3 * Bench::radius, 5 * Bench::mass, Shape::disc, 0.5});
          bench.scene.contact.law = law;
          bench.scene.contact.youngs_modulus = 1e8;
          bench.scene.contact.seed = {0.3, 0.6, 0.1, 1e-3};
          bench.scene.contact.friction_model = model;
          bench.scene.contact.rolling = rolling;
          const auto light = [&] { bench.place(0.5, 0.5, 0.1, 0.3, 20, 0); };
          const auto heavy = [&] { bench.place(0.5 + 2.2 * Bench::radius, 0.5 + 1.2 * Bench::radius, -0.1, 0, 10, 1); };
          if (swapped)
            heavy(), light();
          else
            light(), heavy();
          Simulation& run = bench.start(1e-6);
          run.steps(8000);
          EXPECT_GT(run.statistics().contacts, 50);
          return run.grains();
        };
        const Grains a = impact(false), b = impact(true);
        for (const std::size_t i : {0u, 1u}) {
          EXPECT_EQ(a.x[i], b.x[1 - i]);
          EXPECT_EQ(a.vx[i], b.vx[1 - i]);
          EXPECT_EQ(a.vy[i], b.vy[1 - i]);
          EXPECT_EQ(a.omega[i], b.omega[1 - i]);
        }
      }
}

}  // namespace
}  // namespace vibrosow
