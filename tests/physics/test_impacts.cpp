// Two-body impacts against the exact solution of m x'' + c x' + k x = 0.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "laws/restitution.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

struct Impact {
  double duration, peak_overlap, velocity_0, velocity_1, kinetic_before, kinetic_after;
};

double kinetic(const Simulation& run) {
  return kinetic_energy(run.grains());
}

/// Two grains meet head-on at `speed` relative to each other; the second may be heavier.
Impact head_on(Bench& bench, double speed, int second_lot, double dt) {
  const double r0 = 0.5 * bench.scene.lots[0].diameter;
  const double r1 = 0.5 * bench.scene.lots[static_cast<std::size_t>(second_lot)].diameter;
  const double gap = 1e-3 * r0;
  bench.place(0.5, 0.5, speed, 0).place(0.5 + r0 + r1 + gap, 0.5, 0, 0, 0, second_lot);
  Simulation& run = bench.start(dt);
  Impact impact{0, 0, 0, 0, kinetic(run), 0};
  double touched_at = -1, parted_at = -1;
  double before = -gap;
  while (parted_at < 0 && run.time() < 0.1) {
    if (!run.step()) throw std::runtime_error(*run.guard().stop_reason());
    const double overlap = r0 + r1 - (run.grains().x[1] - run.grains().x[0]);
    // Linear interpolation of the moments of touch and parting.
    if (before <= 0 && overlap > 0) touched_at = run.time() - dt * overlap / (overlap - before);
    if (before > 0 && overlap <= 0) parted_at = run.time() - dt * overlap / (overlap - before);
    impact.peak_overlap = std::max(impact.peak_overlap, overlap);
    before = overlap;
  }
  run.steps(10);
  impact.duration = parted_at - touched_at;
  impact.velocity_0 = run.grains().vx[0];
  impact.velocity_1 = run.grains().vx[1];
  impact.kinetic_after = kinetic(run);
  return impact;
}

class EveryIntegrator : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, EveryIntegrator,
                         testing::Values(Integrator::velocity_verlet, Integrator::rk2_midpoint),
                         [](const auto& name) { return name.param == Integrator::rk2_midpoint ? "rk2" : "verlet"; });

TEST_P(EveryIntegrator, ElasticImpactOfEqualGrainsExchangesVelocities) {
  Bench bench;
  bench.scene.numerics.integrator = GetParam();
  const double speed = 0.1, dt = bench.contact_time() / 400;
  const Impact impact = head_on(bench, speed, 0, dt);
  const double omega = std::numbers::pi / bench.contact_time();
  EXPECT_NEAR(impact.duration, bench.contact_time(), 1e-3 * bench.contact_time());
  EXPECT_NEAR(impact.peak_overlap, speed / omega, 1e-3 * speed / omega);
  EXPECT_NEAR(impact.velocity_0, 0, 1e-4 * speed);
  EXPECT_NEAR(impact.velocity_1, speed, 1e-4 * speed);
  EXPECT_NEAR(impact.kinetic_after, impact.kinetic_before, 1e-4 * impact.kinetic_before);
}

TEST_P(EveryIntegrator, ImpactKeepsMomentumToTheLastBits) {
  Bench bench;
  bench.scene.numerics.integrator = GetParam();
  bench.scene.contact.seed.restitution = 0.3;
  const double speed = 0.1;
  const Impact impact = head_on(bench, speed, 0, bench.contact_time() / 50);
  EXPECT_NEAR(impact.velocity_0 + impact.velocity_1, speed, 1e-14 * speed * 1000);
}

TEST_P(EveryIntegrator, PolydisperseGrainsHaveTheirShellsInSeries) {
  Bench bench;
  bench.scene.numerics.integrator = GetParam();
  bench.scene.lots.push_back({"heavy", 3 * Bench::radius, 5 * Bench::mass, Shape::disc, 0.5});
  const double g = standard_gravity, eps = bench.scene.contact.shell_compression;
  const double c0 = Bench::mass * g / (eps * Bench::radius), c1 = 5 * Bench::mass * g / (eps * 1.5 * Bench::radius);
  const double k = c0 * c1 / (c0 + c1), reduced = Bench::mass * 5 / 6;
  const double duration = std::numbers::pi * std::sqrt(reduced / k), speed = 0.1;
  const Impact impact = head_on(bench, speed, 1, duration / 400);
  EXPECT_NEAR(impact.duration, duration, 1e-3 * duration);
  EXPECT_NEAR(impact.peak_overlap, speed * std::sqrt(reduced / k), 1e-3 * speed * std::sqrt(reduced / k));
  EXPECT_NEAR(impact.velocity_0, speed * (1 - 5.0) / 6, 1e-4 * speed);
  EXPECT_NEAR(impact.velocity_1, speed * 2 / 6, 1e-4 * speed);
}

TEST_P(EveryIntegrator, RestitutionAskedForIsMeasured) {
  for (double asked : {0.05, 0.2, 0.5, 0.7, 0.9}) {
    for (int second : {0, 1}) {
      Bench bench;
      bench.scene.numerics.integrator = GetParam();
      bench.scene.lots.push_back({"heavy", 3 * Bench::radius, 5 * Bench::mass, Shape::disc, 0.5});
      bench.scene.contact.seed.restitution = asked;
      const double speed = 0.1;
      const Impact impact = head_on(bench, speed, second, bench.contact_time() / 5000);
      EXPECT_NEAR((impact.velocity_1 - impact.velocity_0) / speed, asked, 0.005 * asked) << "lot " << second;
    }
  }
}

TEST_P(EveryIntegrator, RestitutionAskedForIsMeasuredOnAWall) {
  for (double asked : {0.2, 0.5, 0.9}) {
    Bench bench;
    bench.scene.numerics.integrator = GetParam();
    bench.scene.contact.wall.restitution = asked;
    bench.place(0.5, 1.01 * Bench::radius, 0, -0.1);
    Simulation& run = bench.start(bench.contact_time() / 1000);
    while (run.grains().vy[0] <= 0 || run.grains().y[0] < Bench::radius * 1.001) ASSERT_TRUE(run.step());
    EXPECT_NEAR(run.grains().vy[0] / 0.1, asked, 0.005 * asked);
  }
}

// The textbook damping, for a force that may pull, gives these with a force that never pulls (PHYSICS: 0.325, 0.550,
// 0.718).
TEST(Restitution, TextbookDampingGivesTooLittleDissipation) {
  const auto textbook = [](double e) {
    const double l = std::log(e);
    return -l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
  };
  EXPECT_NEAR(linear_restitution(textbook(0.2)), 0.325, 5e-4);
  EXPECT_NEAR(linear_restitution(textbook(0.5)), 0.550, 5e-4);
  EXPECT_NEAR(linear_restitution(textbook(0.7)), 0.718, 5e-4);
}

}  // namespace
}  // namespace vibrosow
