// Convergence order of the integrators where the force is smooth: a grain that never leaves a vibrating floor, with
// drag and normal damping.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

struct State {
  double y, vy;
};

State after(Integrator integrator, std::int64_t steps) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.numerics.integrator = integrator;
  bench.scene.contact.shell_compression = 0.01;
  bench.scene.contact.wall.restitution = 0.6;
  bench.scene.contact.drag = 0.02;
  bench.scene.tray.motion = HarmonicMotion{1.5707963267948966, 2e-6, 60, 0};  // 0.03 g: contact is never lost
  const double eps = 0.01 * Bench::radius;
  bench.place(0.5, Bench::radius - 0.9 * eps);
  Simulation& run = bench.start(0.02 / static_cast<double>(steps));
  run.steps(steps);
  return {run.grains().y[0], run.grains().vy[0]};
}

double error(const State& a, const State& b) {
  return std::hypot((a.y - b.y) * 495, a.vy - b.vy);
}

class Order : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Order, testing::Values(Integrator::velocity_verlet, Integrator::rk2_midpoint),
                         [](const auto& name) { return name.param == Integrator::rk2_midpoint ? "rk2" : "verlet"; });

TEST_P(Order, IsTwoWithDragDampingAndAMovingWall) {
  const State exact = after(Integrator::rk2_midpoint, 1 << 17);
  double before = error(after(GetParam(), 256), exact);
  for (std::int64_t steps = 512; steps <= 4096; steps *= 2) {
    const double now = error(after(GetParam(), steps), exact);
    const double order = std::log2(before / now);
    EXPECT_GE(order, 1.9) << steps << " steps";
    EXPECT_LE(order, 2.2) << steps << " steps";
    RecordProperty("order_" + std::to_string(steps), std::to_string(order));
    before = now;
  }
}

TEST(Drag, SlowsAFreeGrainExponentially) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint}) {
    Bench bench;
    bench.scene.numerics.integrator = integrator;
    bench.scene.contact.drag = 3e-3;  // kg/s, mu / m = 5 1/s
    bench.place(0.3, 0.5, 0.5, 0);
    Simulation& run = bench.start(1e-4);
    run.steps(5000);
    EXPECT_NEAR(run.grains().vx[0], 0.5 * std::exp(-5 * 0.5), 1e-6);
  }
}

TEST(FreeFall, IsAParabola) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint}) {
    Bench bench;
    bench.gravity = {0, -standard_gravity};
    bench.scene.numerics.integrator = integrator;
    bench.place(0.3, 0.9, 0.1, 0);
    Simulation& run = bench.start(1e-4);
    run.steps(3000);
    EXPECT_NEAR(run.grains().y[0], 0.9 - 0.5 * standard_gravity * 0.09, 1e-12);
    EXPECT_NEAR(run.grains().x[0], 0.33, 1e-12);
  }
}

}  // namespace
}  // namespace vibrosow
