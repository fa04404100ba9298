// What a grain that leaves takes with it, and what it must not.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

/// Impacts on the floor and in the air, unlike each other, that last from 2 to 8 ms and remember how they went; if
/// asked for, with two grains of lower numbers that fall through a hole side by side meanwhile, past a wall, and are
/// taken out after 5 ms.
struct Impacts {
  Bench bench;

  Impacts(Space space, Integrator integrator, bool with_leavers) : bench(space) {
    Contact& contact = bench.scene.contact;
    contact.shell_compression = 1e-2;
    contact.seed = contact.wall = {.friction = 0.5, .restitution = 1, .rolling_friction = 0.2};
    contact.friction_model = FrictionModel::spring, contact.rolling = Rolling::spring;
    contact.rolling_damping = 0;  // what is damped feels that forces are looked at once more
    bench.scene.numerics.integrator = integrator;
    Hole hole{.centre = 0.3, .width = 0.04};
    if (space == Space::three_dimensional) hole.shape = HoleShape::round, hole.across = 0.5;
    bench.scene.tray.holes = {hole};
    bench.scene.tray.pieces = {{{0.313, -0.01}, {0.313, -0.2}}};
    if (with_leavers) bench.place(0.3, 0.001, 0, -5).place(0.3081, 0.001, 0, -5);
    constexpr double r = Bench::radius, until = 2e-3;  // s, before the touch
    const std::array<double, 3> slide = {0.3, -0.1, 0.05}, spin = {20, 60, -30};
    for (std::size_t k = 0; k < 3; ++k)
      bench.place(0.5 + 0.1 * static_cast<double>(k), r + 0.1 * until, slide[k], -0.1, spin[k]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = 0.2 + 0.2 * static_cast<double>(k);
      bench.place(x, 0.5, 0.1, slide[k], spin[k]).place(x + 2 * r + 0.1 * until, 0.5, 0, 0);
    }
  }
};

class Removal : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Spaces, Removal, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(Removal, LeavesTheOthersWhatTheyRemember) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5}) {
    SCOPED_TRACE(static_cast<int>(integrator));
    Impacts undisturbed(GetParam(), integrator, false), left(GetParam(), integrator, true);
    constexpr double dt = 1e-5, removed_at = 5e-3;
    Simulation &alone = undisturbed.bench.start(dt), &with = left.bench.start(dt);
    while (with.time() < removed_at - 1.5 * dt) ASSERT_TRUE(with.step() && alone.step());
    EXPECT_LT(with.state().contacts.walls.front().grain, 2) << "near the wall that they pass";
    EXPECT_LT(with.state().contacts.pairs.grain.front(), 2) << "and near each other";
    ASSERT_TRUE(with.step() && alone.step());
    ASSERT_EQ(with.grains().size(), alone.grains().size()) << "they have been taken out";
    ASSERT_EQ(with.result().balance.counted, 2);
    ASSERT_GT(alone.field().elastic_energy(), 0) << "in the midst of the impacts";
    while (with.time() < 0.012) ASSERT_TRUE(with.step() && alone.step());
    ASSERT_EQ(alone.field().elastic_energy(), 0) << "after them";
    for (std::size_t i = 0; i < alone.grains().size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_LT((velocity_of(with.grains(), i) - velocity_of(alone.grains(), i)).norm(), 1e-9);
      EXPECT_LT((turning_of(with.grains(), i) - turning_of(alone.grains(), i)).norm(), 1e-7);
    }
  }
}

/// No gravity; past the counting line before 5 ms, when what was counted is taken out, and then every 5 ms.
Bench& falling_through(Bench& bench) {
  Hole hole{.centre = 0.3, .width = 0.04};
  if (bench.scene.space == Space::three_dimensional) hole.shape = HoleShape::round, hole.across = 0.5;
  bench.scene.tray.holes = {hole};
  bench.scene.contact.shell_compression = 1e-2;  // contacts of 6.3 ms
  return bench;
}

TEST_P(Removal, WaitsUntilWhatFellTogetherHasParted) {
  Bench bench(GetParam());
  const double beside = Bench::radius + 0.1 * 1e-3;
  falling_through(bench).place(0.3 - beside, 0.001, 0.1, -10).place(0.3 + beside, 0.001, -0.1, -10);
  Simulation& run = bench.start(1e-5);
  const double energy = kinetic_energy(run.grains());
  while (run.time() < 7e-3) ASSERT_TRUE(run.step());
  EXPECT_EQ(run.result().balance.counted, 2);
  EXPECT_EQ(run.grains().size(), 2u) << "they still push each other";
  while (run.time() < 0.011) ASSERT_TRUE(run.step());
  EXPECT_EQ(run.grains().size(), 0u);
  EXPECT_NEAR(run.result().energy.removed, energy, 1e-4 * energy);
}

TEST_P(Removal, TakesWhatAWallHoldsOutOfTheAccountToo) {
  Bench bench(GetParam());
  bench.scene.tray.pieces = {{{0.2, -0.03}, {0.4, -0.03}}};  // under the hole
  const double speed = 0.2, touch = 3e-3;                    // m/s, s: it stands nearly still when it is taken out
  falling_through(bench).place(0.3, -0.03 + Bench::radius + speed * touch, 0, -speed);
  bench.scene.run.count_below = 0.01;
  Simulation& run = bench.start(1e-5);
  const double energy = kinetic_energy(run.grains());
  while (run.grains().size() == 1) ASSERT_TRUE(run.step() && run.time() < 1);
  EXPECT_NEAR(run.time(), 5e-3, 1e-4);
  EXPECT_NEAR(run.result().energy.removed, energy, 1e-3 * energy) << "most of it in the wall's contact";
}

double energy_of(Simulation& run, const Eigen::Vector2d& gravity) {
  return kinetic_energy(run.grains()) + potential_energy(run.grains(), gravity) + run.field().elastic_energy();
}

TEST_P(Removal, TakesItsEnergyOutOfTheAccount) {
  // One falls through a hole, one bounces on the floor without a loss; the tray is below the height that counts as 0.
  Bench bench(GetParam());
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.origin.y() = -2;
  Hole hole{.centre = 0.3, .width = 0.04};
  if (GetParam() == Space::three_dimensional) hole.shape = HoleShape::round, hole.across = 0.5;
  bench.scene.tray.holes = {hole};
  bench.place(0.3, -1.99, 0, -1).place(0.6, -2 + 1.5 * Bench::radius);
  Simulation& run = bench.start(bench.contact_time() / 200);
  const double before = energy_of(run, bench.gravity), falling = mechanical_energy(run.grains(), 0, bench.gravity);
  while (run.grains().size() == 2) ASSERT_TRUE(run.step());
  const double removed = run.result().energy.removed;
  EXPECT_NEAR(removed, falling, 1e-9 * std::abs(falling)) << "free fall loses nothing";
  EXPECT_NEAR(energy_of(run, bench.gravity) + removed, before, 1e-6 * std::abs(before));
  while (run.time() < 0.1) ASSERT_TRUE(run.step());
  EXPECT_LT(run.result().energy.made_by_numerics, 1e-3 * std::abs(removed)) << "nor does the guard take it for a gain";
}

}  // namespace
}  // namespace vibrosow
