// What contacts do beside what makes a whole impact: limits, slopes, memory, and what the guard is told of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

constexpr double r = Bench::radius;
constexpr double wall_stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);  // N/m, of a shell

class ContactDetails : public testing::TestWithParam<Space> {
 protected:
  bool is_3d() const { return GetParam() == Space::three_dimensional; }
  /// m r^2 / I
  double per_inertia() const { return is_3d() ? 2.5 : 2; }
};
INSTANTIATE_TEST_SUITE_P(Spaces, ContactDetails, testing::ValuesIn(both_spaces), named_by_space);

double torque_on(const Simulation& run, std::size_t i) {  // N m, about z
  return run.grains().is_3d ? run.field().torques_3d()[i].z : run.field().forces()[i].torque;
}

TEST_P(ContactDetails, CohesionAddsNothingToFrictionsLimit) {
  for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring}) {
    Bench bench(GetParam());
    const double overlap = 1e-5, repulsion = wall_stiffness * overlap, cohesion = 0.3 * repulsion;
    bench.scene.contact.wall = {.friction = 0.4, .cohesion = cohesion};
    bench.scene.contact.friction_model = model;
    bench.place(0.5, r - overlap, 1, 0);
    Simulation& run = bench.start(1e-7);
    run.steps(200);  // the spring is at its limit
    const Eigen::Vector3d force = force_on(run, 0);
    EXPECT_GT(force.y(), 0.5 * repulsion);
    EXPECT_NEAR(force.x(), -0.4 * (force.y() + cohesion), 1e-9 * repulsion);
  }
}

TEST_P(ContactDetails, AnElasticCohesiveImpactKeepsItsEnergy) {
  Bench bench(GetParam());
  bench.scene.contact.wall.cohesion = 0.1;
  bench.place(0.5, r + 1e-7, 0, -0.1);
  Simulation& run = bench.start(1e-7);
  const double before = kinetic_energy(run.grains());
  double deepest = 0;
  while (run.time() < 2e-3) {
    ASSERT_TRUE(run.step());
    deepest = std::max(deepest, r - run.grains().y[0]);
    ASSERT_NEAR(kinetic_energy(run.grains()) + run.field().elastic_energy(), before, 2e-3 * before);
  }
  EXPECT_GT(0.1 * deepest, 0.1 * before) << "what coheres counts";
}

TEST_P(ContactDetails, AGrainThatSwingsOnItsTangentialSpringKeepsItsEnergy) {
  Bench bench(GetParam());
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.wall.friction = 0.5;
  bench.scene.contact.friction_model = FrictionModel::spring;
  const double stiffness = 14.0 / 17 * wall_stiffness, omega = std::sqrt(stiffness * (1 + per_inertia()) / Bench::mass);
  const double push = 0.05 * Bench::mass * standard_gravity / stiffness * omega;  // a tenth of what friction holds
  bench.place(0.5, r - 1e-4 * r, push, 0);
  Simulation& run = bench.start(2 * Bench::pi / omega / 100);
  const auto energy = [&] {
    return kinetic_energy(run.grains()) + potential_energy(run.grains(), bench.gravity) + run.field().elastic_energy();
  };
  const double before = energy(), swing = 0.5 * Bench::mass * push * push / (1 + per_inertia());
  for (int step = 0; step < 1000; ++step) {
    ASSERT_TRUE(run.step());
    ASSERT_NEAR(energy(), before, 0.02 * swing);
  }
}

TEST_P(ContactDetails, AConstantRollingTorqueIsLinearBelowTheSlipSpeed) {
  for (const bool on_wall : {true, false}) {
    Bench bench(GetParam());
    bench.scene.contact.seed = bench.scene.contact.wall = {.friction = 0.4, .rolling_friction = 0.05};
    bench.scene.contact.rolling = Rolling::constant_torque;
    bench.scene.contact.slip_speed = 0.02;
    const double overlap = 1e-6, spin = 0.3;  // rad/s
    // Nothing slides.
    if (on_wall)
      bench.place(0.5, r - overlap, -spin * (r - overlap), 0, spin);
    else
      bench.place(0.5, 0.5, 0, -spin * (r - 0.5 * overlap), spin).place(0.5 + 2 * r - overlap, 0.5);
    const double rolling_radius = on_wall ? r : 0.5 * r, repulsion = (on_wall ? 1 : 0.5) * wall_stiffness * overlap;
    const double expected = -0.05 * rolling_radius * repulsion * rolling_radius * spin / 0.02;
    EXPECT_NEAR(torque_on(bench.start(1e-9), 0), expected, 1e-6 * std::abs(expected));
  }
}

// No steeper than what a step bears: 0.5 / dt of the mass that slides, or of the inertia that rolls.
TEST_P(ContactDetails, AHardContactsSlopesAreThoseOfTheStep) {
  for (const double mass_ratio : {0.0, 1.0, 4.0}) {  // of what is hit; 0: a wall
    Bench bench(GetParam());
    SeedLot other = bench.scene.lots[0];
    other.name = "other", other.mass *= std::max(mass_ratio, 1.0), other.number_fraction = 0.5;
    bench.scene.lots[0].number_fraction = 0.5;
    bench.scene.lots.push_back(other);
    bench.scene.contact.seed = bench.scene.contact.wall = {.friction = 0.5, .rolling_friction = 0.5};
    bench.scene.contact.rolling = Rolling::constant_torque;
    const double overlap = 1e-3 * r, dt = 1e-3, speed = 1e-4, spin = 1e-3;
    if (mass_ratio == 0)
      bench.place(0.5, r - overlap, speed, 0, spin);
    else
      bench.place(0.5, 0.5, 0, speed, spin).place(0.5 + 2 * r - overlap, 0.5, 0, 0, 0, 1);
    Simulation& run = bench.start(dt);
    const double inverse_mass = (1 + (mass_ratio > 0 ? 1 / mass_ratio : 0)) / Bench::mass;
    const double slope = 0.5 / dt / (1 + per_inertia()) / inverse_mass;
    const double arm = r - (mass_ratio == 0 ? 1 : mass_ratio / (1 + mass_ratio)) * overlap;  // the heavier is stiffer
    const double sliding = speed + arm * spin;
    const Eigen::Vector3d force = force_on(run, 0);
    EXPECT_NEAR(mass_ratio == 0 ? force.x() : force.y(), -slope * sliding, 1e-6 * slope * sliding) << mass_ratio;
    const double inertia = Bench::mass * r * r / per_inertia();
    const double rolling_inertia = inertia / (1 + (mass_ratio > 0 ? 1 / mass_ratio : 0));
    const double rolling = -0.5 / dt * rolling_inertia * spin, by_friction = -slope * sliding * arm;
    EXPECT_NEAR(torque_on(run, 0), rolling + by_friction, 1e-6 * std::abs(rolling + by_friction)) << mass_ratio;
    EXPECT_EQ(run.statistics().slip_raised, 1);
  }
}

TEST_P(ContactDetails, TheRelativeOverlapIsThatOfTheDeeperShell) {
  Bench bench(GetParam());
  bench.scene.lots.push_back({"other", r, 2 * Bench::mass, Shape::ball, 0.5});
  const double overlap = 1e-5;
  // 1 / c = eps r / (m g): the small heavy one yields by a quarter of what the other does, over half of its radius.
  bench.place(0.5, 0.5).place(0.5 + 1.5 * r - overlap, 0.5, 0, 0, 0, 1);
  EXPECT_NEAR(bench.start(1e-9).guard().max_relative_overlap(), 0.8 * overlap / r, 1e-6 * overlap / r);
}

/// Balls that press each other and the floor, and slide.
void set_sliding(Bench& bench) {
  bench.scene.contact.seed = bench.scene.contact.wall = {.friction = 0.3, .restitution = 0.6, .rolling_friction = 0.1};
  bench.scene.contact.friction_model = FrictionModel::spring, bench.scene.contact.rolling = Rolling::spring;
  bench.place(0.5, r + 1e-6, 0.3, -0.2, 30).place(0.5 + 2 * r + 1e-6, 1.05 * r, -0.3, 0.1, -20);
}

std::vector<double> memory_of(const ContactState& contacts) {
  std::vector<double> all;
  for (const ContactHistories* h : {&contacts.pair_histories, &contacts.wall_histories}) {
    for (const std::vector<double>* column : {&h->slip, &h->roll})
      all.insert(all.end(), column->begin(), column->end());
    for (std::size_t k = 0; k < h->place.size(); ++k)
      if (h->has_history(k)) all.insert(all.end(), h->record(k), h->record(k) + h->kinds.record_length());
  }
  return all;
}

// The overlap is shared as the shells yield, r / m of each, and friction acts where they meet: none turns from nothing.
TEST_P(ContactDetails, FrictionActsOnTwoUnequalGrainsAtOnePoint) {
  for (const double other_radius : {0.5 * r, 2 * r}) {
    Bench bench(GetParam());
    SeedLot other = bench.scene.lots[0];
    other.name = "other", other.diameter = 2 * other_radius, other.mass = 3 * Bench::mass, other.number_fraction = 0.5;
    bench.scene.lots[0].number_fraction = 0.5;
    bench.scene.lots.push_back(other);
    bench.scene.contact.seed.friction = 0.4;
    const double overlap = 0.02 * r, distance = r + other_radius - overlap;
    bench.place(0.5, 0.5, 0, 1).place(0.5 + distance, 0.5, 0, 0, 0, 1);
    const Simulation& run = bench.start(1e-9);
    const double yields = r / Bench::mass, other_yields = other_radius / (3 * Bench::mass);
    const double arm = r - overlap * yields / (yields + other_yields), friction = force_on(run, 0).y();
    EXPECT_LT(friction, 0);
    EXPECT_NEAR(torque_on(run, 0) / friction, arm, 1e-6 * r) << other_radius;
    EXPECT_NEAR(torque_on(run, 1) / friction, distance - arm, 1e-6 * r) << other_radius;
  }
}

TEST_P(ContactDetails, ALookAtTheForcesLeavesNoTrace) {
  Bench bench(GetParam());
  set_sliding(bench);
  Simulation& run = bench.start(1e-6);
  run.steps(150);
  const std::vector<double> before = memory_of(run.state().contacts);
  run.field().evaluate(run.time(), {});
  EXPECT_EQ(memory_of(run.state().contacts), before);
  // Of both contacts the slip and the roll, in 3D the parts of them that there are in this plane.
  EXPECT_EQ(std::ranges::count_if(before, [](double x) { return x != 0; }), is_3d() ? 5 : 4);
  // Nor where nothing touches at that moment, as in the middle of a step it may not.
  for (const double direction : {-1, 1}) run.grains().x[direction < 0 ? 0 : 1] += direction * 1e-4;
  for (double& height : run.grains().y) height += 1e-4;
  run.field().evaluate(run.time(), {});
  EXPECT_EQ(force_on(run, 0).norm(), 0);
  EXPECT_EQ(memory_of(run.state().contacts), before);
}

// By as much as the two have moved past each other: a wall's speed at a step's end alone would be half a step late.
TEST_P(ContactDetails, ASpringSlipsWithTheMeanSpeedOfItsWall) {
  Bench bench(GetParam());
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.wall.friction = 5, bench.scene.contact.rotation = false;
  bench.scene.contact.friction_model = FrictionModel::spring;
  const double amplitude = 2e-6, omega = 2 * Bench::pi * 200;
  bench.scene.tray.motion = HarmonicMotion{.amplitude = amplitude, .frequency = omega / (2 * Bench::pi)};
  bench.place(0.5, r * (1 - 1e-4), amplitude * omega, 0);
  const double dt = 2e-6;
  Simulation& run = bench.start(dt);
  for (int k = 0; k < 5; ++k) {
    run.steps(200);
    const double moved = run.grains().x[0] - 0.5 - amplitude * std::sin(omega * run.time());
    EXPECT_GT(std::abs(moved), 1e-8) << "it swings on its spring";
    EXPECT_NEAR(memory_of(run.state().contacts)[0], moved, 1e-3 * dt * amplitude * omega) << run.time() << " s";
  }
}

TEST_P(ContactDetails, NothingIsRememberedOfWhatHasParted) {
  Bench bench(GetParam());
  set_sliding(bench);
  Simulation& run = bench.start(1e-6);
  run.steps(150);
  EXPECT_GT(run.field().elastic_energy(), 0);
  run.steps(1500);
  EXPECT_EQ(run.field().elastic_energy(), 0) << "they have parted";
  for (const double number : memory_of(run.state().contacts)) EXPECT_EQ(number, 0);
}

// The walls' work is all that an elastic gas without friction gains, whichever way its vessel is shaken.
TEST_P(ContactDetails, TheWorkOfAShakenVesselIsAccountedForUnderEveryScheme) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5}) {
    Bench bench(GetParam());
    bench.scene.numerics.integrator = integrator;
    Vessel& tray = bench.scene.tray;
    tray.length = 0.04;
    if (is_3d()) tray.depth = 0.03;
    tray.motion = HarmonicMotion{.direction = 0.4, .amplitude = 2e-3, .frequency = 30, .across = is_3d() ? 0.8 : 0};
    for (int k = 0; k < 4; ++k)
      bench.place({0.006 + 0.009 * k, 0.006 + 0.003 * k, 0.015}, {0.2 - 0.1 * k, -0.3, is_3d() ? 0.3 - 0.2 * k : 0});
    bench.gravity = {0, -standard_gravity};
    Simulation& run = bench.start(bench.contact_time() / 200);
    const double before = kinetic_energy(run.grains()) + potential_energy(run.grains(), bench.gravity);
    while (run.time() < 0.2) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    const double now =
        kinetic_energy(run.grains()) + potential_energy(run.grains(), bench.gravity) + run.field().elastic_energy();
    const double work = run.state().integrator.wall_work;
    ASSERT_GT(std::abs(work), 1e-5);
    EXPECT_NEAR(now - before, work, 0.01 * std::abs(work)) << static_cast<int>(integrator);
  }
}

TEST_P(ContactDetails, ARunWhoseStopWasRaisedIsMarkedWhereItNeededThat) {
  for (const double stop : {0.5, 10.0})
    for (const double speed : {0.01, 2.0}) {
      Bench bench(GetParam());
      bench.scene.guard.stop_relative_overlap = stop;
      bench.place(0.5, r + 1e-6, 0, -speed);
      Simulation& run = bench.start(1e-6);
      run.steps(1000);
      EXPECT_EQ(run.result().outside_the_model, stop > 0.5 && speed > 1);
      EXPECT_EQ(run.result().max_relative_overlap > 0.05, speed > 1);
    }
}

TEST_P(ContactDetails, AnElasticWallYieldsBesideTheGrain) {
  Bench bench(GetParam());
  bench.hertz_ball(1e7, 0.3, 1000, r);
  bench.scene.contact.wall_youngs_modulus = 3e6, bench.scene.contact.wall_poisson_ratio = 0.4;
  const double overlap = 1e-5;
  bench.place(0.5, r - overlap);
  const double modulus = 1 / ((1 - 0.09) / 1e7 + (1 - 0.16) / 3e6);
  const double expected = 4.0 / 3 * modulus * std::sqrt(r) * std::pow(overlap, 1.5);
  EXPECT_NEAR(force_on(bench.start(1e-9), 0).y(), expected, 1e-9 * expected);
}

TEST(Sizes, BallsOfHertzPressByTheirOwnRadius) {
  Bench bench;
  bench.hertz_ball(1e7, 0.3, 1000, r);
  bench.scene.lots[0].sizes = {SizeDistribution::Kind::uniform, 2 * r, 0, r, 2 * r, {}, {}};
  Model model = with_step(prepare(bench.scene), 1e-9);
  model.gravity = {0, 0};
  Grains grains = no_grains(model);
  const double overlap = 1e-5;
  grains.add(0.5, 0.5 * r - overlap, 0, 0, 0, sized_kind(model.scene.lots[0], *model.law, model.kinds[0], 0.5));
  Simulation run(model, starting_state(model, 1, grains));
  const double expected = 4.0 / 3 * 1e7 / (1 - 0.09) * std::sqrt(0.5 * r) * std::pow(overlap, 1.5);
  EXPECT_NEAR(force_on(run, 0).y(), expected, 1e-9 * expected);
}

}  // namespace
}  // namespace vibrosow
