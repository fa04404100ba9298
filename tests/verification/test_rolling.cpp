// Rolling resistance: a torque mu_r F R against rolling.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow::rolling_test {
namespace {

struct Case {
  Law law;
  Shape shape;
  Rolling kind;

  std::string law_name() const { return law == Law::hertz ? "hertz" : "elastic_shell"; }
  std::string shape_name() const { return shape == Shape::ball ? "ball" : "disc"; }
  std::string kind_name() const { return kind == Rolling::spring ? "spring" : "constant_torque"; }
  double gyration() const { return shape == Shape::ball ? 0.4 : 0.5; }  // I / (m r^2)
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Shape shape : {Shape::disc, Shape::ball})
      for (const Rolling kind : {Rolling::constant_torque, Rolling::spring}) all.push_back({law, shape, kind});
  return all;
}

/// A grain that lies on the floor under the weight m g cos(theta), with a tangential spring that holds it.
Bench lying(const Case& c, double rolling_friction, double tangent, double speed) {
  Bench bench;
  const double theta = std::atan(tangent), modulus = 1e9, poisson = 0.3;
  bench.gravity = standard_gravity * Eigen::Vector2d(std::sin(theta), -std::cos(theta));
  bench.scene.lots[0].shape = c.shape;
  bench.scene.contact.law = c.law;
  bench.scene.contact.shell_compression = 1e-5;
  bench.scene.contact.youngs_modulus = modulus;
  bench.scene.contact.wall = {0.8, 0.5, rolling_friction};
  bench.scene.contact.friction_model = FrictionModel::spring;
  bench.scene.contact.rolling = c.kind;
  bench.scene.contact.slip_speed = 1e-4;
  const double stiffness = 4.0 / 3 * modulus / (1 - poisson * poisson) * std::sqrt(Bench::radius);
  const double weight = Bench::mass * standard_gravity * std::cos(theta);
  const double overlap =
      c.law == Law::hertz ? std::pow(weight / stiffness, 2.0 / 3) : 1e-5 * Bench::radius * std::cos(theta);
  bench.place(0.1, Bench::radius - overlap, speed, 0, -speed / (Bench::radius - overlap));
  return bench;
}

// A rolling grain, I + m r^2 about the contact, is braked by the torque mu_r m g r: a = mu_r g / (1 + I / (m r^2)), so
// that it stops after v^2 / (2 a).
TEST(Rolling, ATorqueStopsARollingGrain) {
  VerificationReport report("rolling_distance",
                            "a grain set rolling at 0.1 m/s on a level floor, rolling friction 0.02",
                            {"law", "shape", "rolling", "distance_theory_mm", "distance_mm", "deviation_percent"});
  for (const Case& c : cases()) {
    const double speed = 0.1, rolling_friction = 0.02;
    const double braking = rolling_friction * standard_gravity / (1 + c.gyration());
    const double expected = speed * speed / (2 * braking);
    Bench bench = lying(c, rolling_friction, 0, speed);
    Simulation& run = bench.start(4e-6);
    while (run.time() < 1.2 * speed / braking) ASSERT_TRUE(run.step());
    const double distance = run.grains().x[0] - 0.1;
    EXPECT_LT(std::abs(run.grains().vx[0]), 1e-4 * speed) << c.kind_name();
    EXPECT_NEAR(distance, expected, 0.005 * expected) << c.law_name() << c.shape_name() << c.kind_name();
    report.add(c.law_name(), c.shape_name(), c.kind_name(), expected * 1e3, distance * 1e3,
               100 * (distance / expected - 1));
  }
}

// On a slope the weight's moment m g r sin(theta) stands against mu_r m g r cos(theta): at rest for tan(theta) < mu_r,
// beyond it a = g (sin(theta) - mu_r cos(theta)) / (1 + I / (m r^2)). The torque of constant size, made continuous,
// lets the grain creep below the slip speed instead of resting.
TEST(Rolling, HoldsOnASlopeUpToItsLimit) {
  VerificationReport report("rolling_slope",
                            "a grain on a slope, rolling friction 0.1; acceleration over g sin(theta), and "
                            "the speed 0.2 s after the start at rest",
                            {"law", "shape", "rolling", "tan_theta_over_rolling_friction", "theory", "computed",
                             "deviation_percent_of_g_sin_theta", "speed_mm_per_s"});
  for (const Case& c : cases())
    for (const double of_limit : {0.5, 0.95, 1.05, 2.0}) {
      const double rolling_friction = 0.1, tangent = of_limit * rolling_friction;
      Bench bench = lying(c, rolling_friction, tangent, 0);
      Simulation& run = bench.start(4e-6);
      run.steps(25000);
      const double speed = run.grains().vx[0];
      run.steps(25000);
      const double down = standard_gravity * std::sin(std::atan(tangent));
      const double computed = (run.grains().vx[0] - speed) / 0.1 / down;
      const double expected = of_limit < 1 ? 0 : (1 - rolling_friction / tangent) / (1 + c.gyration());
      SCOPED_TRACE(c.law_name() + " " + c.shape_name() + " " + c.kind_name() + " " + std::to_string(of_limit));
      if (of_limit > 1) {
        EXPECT_NEAR(computed, expected, 0.005 * expected);
      } else {
        const double creep = c.kind == Rolling::spring ? 1e-12 : 1.01e-4 * of_limit;  // m/s; the slip speed is 1e-4
        EXPECT_LT(std::abs(run.grains().vx[0]), creep);
      }
      report.add(c.law_name(), c.shape_name(), c.kind_name(), of_limit, expected, computed, 100 * (computed - expected),
                 run.grains().vx[0] * 1e3);
    }
}

}  // namespace
}  // namespace vibrosow::rolling_test
