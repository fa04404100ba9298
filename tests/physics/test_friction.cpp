// Direction, size and torque of friction.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

TEST(Friction, OpposesSlidingOnTheFloorAndTurnsTheGrain) {
  Bench bench;
  bench.scene.contact.wall.friction = 0.3;
  const double overlap = 1e-6;
  bench.place(0.5, Bench::radius - overlap, 1, 0);
  Simulation& run = bench.start(1e-9);
  const Forces& forces = run.field().forces();
  EXPECT_LT(forces[0].fx, 0);
  EXPECT_NEAR(-forces[0].fx, 0.3 * forces[0].fy, 1e-12 * forces[0].fy);
  // Sliding to the right, the floor drags the lowest point back: clockwise, negative.
  EXPECT_NEAR(forces[0].torque, (Bench::radius - overlap) * forces[0].fx, 1e-15);
}

TEST(Friction, SpinAloneDrivesTheGrainAlong) {
  Bench bench;
  bench.scene.contact.wall.friction = 0.3;
  bench.place(0.5, Bench::radius - 1e-6, 0, 0, -100);  // clockwise: its lowest point moves left
  Simulation& run = bench.start(1e-9);
  EXPECT_GT(run.field().forces()[0].fx, 0);
  EXPECT_GT(run.field().forces()[0].torque, 0);
}

TEST(Friction, RollingWithoutSlidingFeelsNone) {
  Bench bench;
  bench.scene.contact.wall.friction = 0.3;
  const double arm = Bench::radius - 1e-6;
  bench.place(0.5, arm, 0.4, 0, -0.4 / arm);
  Simulation& run = bench.start(1e-9);
  EXPECT_NEAR(run.field().forces()[0].fx, 0, 1e-12);
}

TEST(Friction, BothGrainsOfAPairGetTorqueOfTheSameSign) {
  Bench bench;
  bench.scene.contact.seed.friction = 0.3;
  bench.place(0.5, 0.5, 0, 0.2).place(0.5 + 2 * Bench::radius - 2e-6, 0.5);
  Simulation& run = bench.start(1e-9);
  const Forces& f = run.field().forces();
  // n = (1, 0), t = (0, 1), W > 0.
  EXPECT_LT(f[0].fy, 0);
  EXPECT_EQ(f[0].fy, -f[1].fy);
  EXPECT_LT(f[0].torque, 0);
  EXPECT_EQ(f[0].torque, f[1].torque);
}

TEST(Friction, ArmsToTheContactPointKeepAngularMomentum) {
  for (const FrictionArm arm : {FrictionArm::contact_point, FrictionArm::rim}) {
    Bench bench;
    bench.scene.lots.push_back({"heavy", 3 * Bench::radius, 5 * Bench::mass, Shape::disc, 0.5});
    bench.scene.contact.shell_compression = 0.01;
    bench.scene.contact.seed.friction = 0.3;
    bench.scene.contact.friction_arm = arm;
    const double reach = 2.5 * Bench::radius;
    bench.place(0.5, 0.5, 0.1, 0.3, 20).place(0.5 + 1.001 * reach, 0.5, -0.1, 0, 10, 1);
    const auto angular_momentum = [](const Simulation& run) {
      double sum = 0;
      const Grains& g = run.grains();
      for (std::size_t i = 0; i < 2; ++i)
        sum += g.kind(i).mass * (g.x[i] * g.vy[i] - g.y[i] * g.vx[i]) + g.omega[i] / g.kind(i).inverse_inertia;
      return sum;
    };
    Simulation& run = bench.start(1e-6);
    const double before = angular_momentum(run), scale = Bench::mass * 0.3 * Bench::radius;
    run.steps(20000);
    ASSERT_GT(run.statistics().contacts, 1000);
    const double change = std::abs(angular_momentum(run) - before) / scale;
    if (arm == FrictionArm::contact_point)
      EXPECT_LT(change, 1e-9);
    else
      EXPECT_GT(change, 1e-3) << "the paper's rims do not keep it, and the test must be able to tell";
  }
}

// Gross sliding through a whole oblique impact: spin and tangential speed change by (1 + e) nu v_n m / J r and (1 + e)
// nu v_n.
TEST(Friction, ObliqueImpactInGrossSliding) {
  Bench bench;
  bench.scene.contact.wall = {0.1, 0.8};
  bench.scene.contact.shell_compression = 1e-6;
  const double normal = 0.2, tangential = 1.0;  // W_0 > 3 nu (1 + e) v_n = 0.108 m/s
  bench.place(0.3, 1.001 * Bench::radius, tangential, -normal);
  Simulation& run = bench.start(bench.contact_time() / 1000);
  while (run.grains().vy[0] <= 0 || run.grains().y[0] < 1.001 * Bench::radius) ASSERT_TRUE(run.step());
  const double lost = 1.8 * 0.1 * normal;
  EXPECT_NEAR(tangential - run.grains().vx[0], lost, 0.005 * lost);
  EXPECT_NEAR(-run.grains().omega[0] * Bench::radius, 2 * lost, 0.005 * 2 * lost);
}

}  // namespace
}  // namespace vibrosow
