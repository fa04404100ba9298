// Slip to roll, and grains on a slope: sliding and spring friction, ball and disc, against rigid-body theory.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow::slip_test {
namespace {

struct Case {
  Law law;
  Shape shape;
  FrictionModel model;

  std::string name() const {
    return std::string(law == Law::hertz ? "hertz " : "elastic_shell ") + (shape == Shape::ball ? "ball " : "disc ") +
           (model == FrictionModel::spring ? "spring" : "sliding");
  }
  double gyration() const { return shape == Shape::ball ? 0.4 : 0.5; }  // I / (m r^2)
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Shape shape : {Shape::disc, Shape::ball})
      for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring})
        all.push_back({law, shape, model});
  return all;
}

Bench bench_of(const Case& c, double friction) {
  Bench bench;
  bench.scene.lots[0].shape = c.shape;
  bench.scene.contact.law = c.law;
  bench.scene.contact.youngs_modulus = 1e8;
  bench.scene.contact.wall = {friction, 0.5};
  bench.scene.contact.friction_model = c.model;
  bench.scene.contact.slip_speed = 1e-4;
  return bench;
}

/// Overlap of grain 0 that lies on the floor under `weight` (N), m.
double resting_overlap(const Bench& bench, double weight) {
  const Contact& c = bench.scene.contact;
  if (c.law == Law::elastic_shell)
    return c.shell_compression * Bench::radius * weight / (Bench::mass * standard_gravity);
  const double modulus = c.youngs_modulus / (1 - c.poisson_ratio * c.poisson_ratio);
  return std::pow(weight / (4.0 / 3 * modulus * std::sqrt(Bench::radius)), 2.0 / 3);
}

// On a level floor a disc ends at 2/3 u_0 after u_0 / (3 mu g), a ball at 5/7 u_0 after 2 u_0 / (7 mu g).
TEST(Slip, TurnsToRolling) {
  VerificationReport report(
      "slip_to_roll", "a grain set sliding on a level floor at 0.2 m/s, friction 0.3: when and how it ends rolling",
      {"case", "roll_time_theory_s", "roll_time_s", "roll_time_deviation_percent", "end_speed_over_start_theory",
       "end_speed_over_start", "deviation_percent"});
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name());
    Bench bench = bench_of(c, 0.3);
    bench.gravity = {0, -standard_gravity};
    const double start = 0.2, part = c.shape == Shape::disc ? 1.0 / 3 : 2.0 / 7;
    const double overlap = resting_overlap(bench, Bench::mass * standard_gravity), arm = Bench::radius - overlap;
    bench.place(0.1, arm, start);
    Simulation& run = bench.start(2e-6);
    const double rolls_at = part * start / (0.3 * standard_gravity);
    double half_way = 0, stuck_at = 0;
    while (run.time() < 1.5 * rolls_at) {
      ASSERT_TRUE(run.step());
      const double sliding = run.grains().vx[0] + arm * run.grains().omega[0];
      if (stuck_at == 0 && sliding <= 1e-3 * start) stuck_at = run.time();
      if (half_way == 0 && run.time() >= 0.5 * rolls_at) {
        half_way = run.time();
        EXPECT_NEAR(run.grains().vx[0], start - 0.3 * standard_gravity * half_way, 0.005 * start);
      }
    }
    const double ratio = run.grains().vx[0] / start;
    EXPECT_NEAR(stuck_at, rolls_at, 0.005 * rolls_at);
    EXPECT_NEAR(ratio, 1 - part, 0.005 * (1 - part));
    EXPECT_NEAR(-run.grains().omega[0] * arm, run.grains().vx[0], 0.005 * start);
    report.add(c.name(), rolls_at, stuck_at, 100 * (stuck_at / rolls_at - 1), 1 - part, ratio,
               100 * (ratio / (1 - part) - 1));
  }
}

/// Acceleration down a slope over g sin(theta), between 0.05 and 0.1 s after the start at rest: by then the slip speed
/// is passed, or the tangential spring stretched, whose fraction in a slow start is no matter of the slope's.
double acceleration(const Case& c, double friction, double tangent, bool rotation) {
  Bench bench = bench_of(c, friction);
  const double theta = std::atan(tangent);
  bench.gravity = standard_gravity * Eigen::Vector2d(std::sin(theta), -std::cos(theta));
  bench.scene.contact.rotation = rotation;
  bench.place(0.1, Bench::radius - resting_overlap(bench, Bench::mass * standard_gravity * std::cos(theta)));
  Simulation& run = bench.start(2e-6);
  run.steps(25000);
  const double speed = run.grains().vx[0], since = run.time();
  run.steps(25000);
  return (run.grains().vx[0] - speed) / (run.time() - since) / (standard_gravity * std::sin(theta));
}

// A grain on a slope rolls, and slips only for tan(theta) > nu (1 + m r^2 / I): 3 nu for a disc, 3.5 nu for a ball;
// kept from turning it slips for tan(theta) > nu.
TEST(Slip, OnASlope) {
  VerificationReport report(
      "slopes",
      "acceleration over g sin(theta) of a grain on a slope, friction 0.2, 5 % below and above the slip limits",
      {"case", "rotation", "tan_theta_over_limit", "theory", "computed", "deviation_percent_of_g_sin_theta"});
  const double nu = 0.2;
  for (const Case& c : cases())
    for (const bool rotation : {true, false})
      for (const double of_limit : {0.5, 0.95, 1.05, 1.5}) {
        SCOPED_TRACE(testing::Message() << c.name() << " rotation " << rotation << " at " << of_limit);
        const double limit = rotation ? nu * (1 + 1 / c.gyration()) : nu, tangent = of_limit * limit;
        const double below = rotation ? 1 / (1 + c.gyration()) : 0;
        const double expected = of_limit < 1 ? below : 1 - nu / tangent;
        const double computed = acceleration(c, nu, tangent, rotation);
        EXPECT_NEAR(computed, expected, 0.005 * (expected > 0 ? expected : 1));
        report.add(c.name(), rotation ? "on" : "off", of_limit, expected, computed, 100 * (computed - expected));
      }
}

}  // namespace
}  // namespace vibrosow::slip_test
