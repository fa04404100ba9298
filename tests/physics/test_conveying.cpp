// One grain that cannot turn, carried by a plate that shakes at a slope, against a point mass: stick, slide, flight and
// impact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

struct Plate {
  std::string name;
  double amplitude, frequency, slope;  // m, Hz, rad
  double friction, restitution;

  double omega() const { return 2 * Bench::pi * frequency; }
  double along(double t) const { return amplitude * omega() * std::cos(omega() * t); }
  double x_speed(double t) const { return std::cos(slope) * along(t); }
  double y_speed(double t) const { return std::sin(slope) * along(t); }
  double y(double t) const { return std::sin(slope) * amplitude * std::sin(omega() * t); }
  double x_acceleration(double t) const {
    return -std::cos(slope) * amplitude * omega() * omega() * std::sin(omega() * t);
  }
  double y_acceleration(double t) const { return std::tan(slope) * x_acceleration(t); }
};

constexpr double settled = 10, periods = 30;  // the mean is of those in between

/// A point mass under gravity that begins on the plate with its velocity, in steps of 1e-5 of a period. An impact of
/// normal speed w leaves restitution times w, and takes at most friction times (1 + restitution) w of the sliding
/// speed. Below 0.1 mm/s no bounce is left.
class PointMass {
 public:
  explicit PointMass(const Plate& plate) : plate_(plate) {}

  /// m/s, over whole periods.
  double mean_speed() {
    const double dt = 1e-5 / plate_.frequency;
    double begun = 0;
    const auto steps = static_cast<std::int64_t>(std::llround(periods / plate_.frequency / dt));
    const auto first = static_cast<std::int64_t>(std::llround(settled / plate_.frequency / dt));
    for (std::int64_t i = 0; i < steps; ++i) {
      if (i == first) begun = x_;
      const double t = static_cast<double>(i) * dt;
      if (touches_) on_plate(t, dt);
      if (!touches_) in_flight(t, dt);
      x_ += vx_ * dt;
    }
    return (x_ - begun) / ((periods - settled) / plate_.frequency);
  }

 private:
  void on_plate(double t, double dt) {
    const double normal = standard_gravity + plate_.y_acceleration(t);  // of its unit mass
    if (normal <= 0) {
      touches_ = false, y_ = plate_.y(t), vy_ = plate_.y_speed(t);
      return;
    }
    const double sliding = vx_ - plate_.x_speed(t), most = plate_.friction * normal * dt;
    const double wanted = plate_.x_speed(t + dt) - vx_;  // what keeps it to the plate
    vx_ += std::abs(sliding) <= most ? std::clamp(wanted, -most, most) : -std::copysign(most, sliding);
  }

  void in_flight(double t, double dt) {
    y_ += vy_ * dt - 0.5 * standard_gravity * dt * dt, vy_ -= standard_gravity * dt;
    const double fall = plate_.y_speed(t + dt) - vy_;
    if (y_ > plate_.y(t + dt) || fall < 0) return;
    const double sliding = vx_ - plate_.x_speed(t + dt), taken = plate_.friction * (1 + plate_.restitution) * fall;
    vx_ = plate_.x_speed(t + dt) + std::copysign(std::max(std::abs(sliding) - taken, 0.0), sliding);
    y_ = plate_.y(t + dt), vy_ = plate_.y_speed(t + dt) + plate_.restitution * fall;
    touches_ = plate_.restitution * fall < 1e-4;
  }

  Plate plate_;
  bool touches_ = true;
  double x_ = 0, vx_ = plate_.x_speed(0), y_ = 0, vy_ = 0;
};

double carried_speed(const Plate& plate, Space space, FrictionModel friction_model) {
  Bench bench(space);
  bench.gravity = {0, -standard_gravity};
  Contact& contact = bench.scene.contact;
  contact.shell_compression = 4e-6;
  contact.wall = {plate.friction, plate.restitution};
  contact.friction_model = friction_model;
  contact.slip_speed = 1e-3;
  contact.rotation = false;
  bench.scene.tray.motion =
      HarmonicMotion{.direction = plate.slope, .amplitude = plate.amplitude, .frequency = plate.frequency};
  bench.scene.run.duration = periods / plate.frequency;
  bench.place(0.2, Bench::radius * (1 - 4e-6), plate.x_speed(0), plate.y_speed(0));
  Simulation& run = bench.start(bench.contact_time() / 20);
  while (run.time() < settled / plate.frequency) EXPECT_TRUE(run.step());
  const double begun = run.grains().x[0], from = run.time();
  while (run.time() < periods / plate.frequency && run.step()) {
  }
  return (run.grains().x[0] - begun) / (run.time() - from);
}

class Conveying : public testing::TestWithParam<Plate> {};

TEST_P(Conveying, CarriesAsFastAsAPointMass) {
  const double exact = PointMass(GetParam()).mean_speed();
  EXPECT_GT(exact, 0.01);
  for (const Space space : both_spaces)
    for (const FrictionModel model : {FrictionModel::spring, FrictionModel::sliding}) {
      const double carried = carried_speed(GetParam(), space, model);
      EXPECT_NEAR(carried / exact, 1, 0.01) << (space == Space::two_dimensional ? "plane" : "3D")
                                            << (model == FrictionModel::spring ? ", spring" : ", sliding");
    }
}

constexpr double slope = 30 * Bench::pi / 180;

// Thrown from 1 on: amplitude omega^2 sin(slope) / g is 0.8, 1.3 and 1.6.
INSTANTIATE_TEST_SUITE_P(Plates, Conveying,
                         testing::Values(Plate{"slides", 1e-3, 20, slope, 0.4, 0.3},
                                         Plate{"slides_with_little_friction", 1e-3, 20, slope, 0.15, 0.3},
                                         Plate{"thrown_without_bounce", 2e-3, 20, slope, 0.4, 0.02},
                                         Plate{"thrown_and_bounces", 1.6e-3, 20, slope, 0.4, 0.3}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace vibrosow
