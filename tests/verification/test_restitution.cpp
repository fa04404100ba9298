// Restitution and bounces against theory: what is asked for is what is measured; paper B's damping; bounce heights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow {
namespace {

constexpr double asked_for[] = {0.05, 0.2, 0.5, 0.7, 0.9, 1.0};

/// Grains of 4 mm and a second lot of other size and mass; either law.
Bench two_lots(Law law) {
  Bench bench;
  bench.scene.contact.law = law;
  bench.scene.contact.youngs_modulus = 1e9;
  bench.scene.lots.push_back({"heavy", 3 * Bench::radius, 5 * Bench::mass, Shape::disc, 0.5});
  return bench;
}

/// Elastic contact time of grain 0 with `other` (-1: a wall), s.
double contact_time(const Bench& bench, int other, double speed) {
  const Contact& c = bench.scene.contact;
  const auto inverse = [&](int lot) { return lot < 0 ? 0 : 1 / bench.scene.lots[static_cast<std::size_t>(lot)].mass; };
  const auto radius = [&](int lot) { return 0.5 * bench.scene.lots[static_cast<std::size_t>(lot)].diameter; };
  const double reduced = 1 / (inverse(0) + inverse(other));
  if (c.law == Law::elastic_shell) {
    const auto compliance = [&](int lot) {
      return lot < 0 ? 0 : c.shell_compression * radius(lot) * inverse(lot) / standard_gravity;
    };
    return Bench::pi * std::sqrt(reduced * (compliance(0) + compliance(other)));
  }
  const double sides = other < 0 ? 1 : 2, curvature = 1 / radius(0) + (other < 0 ? 0 : 1 / radius(other));
  const double modulus = c.youngs_modulus / (1 - c.poisson_ratio * c.poisson_ratio) / sides;
  return HertzImpact(reduced, 4.0 / 3 * modulus / std::sqrt(curvature), speed).duration;
}

// Head-on, equal and polydisperse grains and a wall, three decades of speed, both laws that take a restitution.
TEST(Restitution, AskedForIsMeasured) {
  VerificationReport report(
      "restitution_asked", "restitution asked for and measured, equal and polydisperse grains and a wall",
      {"law", "against", "speed_m_per_s", "restitution_asked", "restitution", "deviation_percent"});
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const int other : {0, 1, -1})
      for (const double speed : {0.005, 0.1, 2.0})
        for (const double asked : asked_for) {
          Bench bench = two_lots(law);
          bench.scene.guard.stop_relative_overlap = 100;  // a shell at 2 m/s is pressed far beyond a thin shell's use
          bench.scene.contact.seed.restitution = bench.scene.contact.wall.restitution = asked;
          const double dt = contact_time(bench, other, speed) / 4000;
          double measured = 0;
          if (other < 0) {
            measured = wall_impact(bench, speed, 0, dt).vy / speed;
          } else {
            const ImpactResult impact = head_on_impact(bench, speed, other, dt);
            measured = (impact.other_vx - impact.vx) / speed;
          }
          const std::string against = other < 0 ? "wall" : other == 0 ? "equal grain" : "polydisperse grain";
          const std::string name = law == Law::hertz ? "hertz" : "elastic_shell";
          EXPECT_NEAR(measured, asked, 0.005 * asked) << name << " " << against << " " << speed << " m/s";
          report.add(name, against, speed, asked, measured, 100 * (measured / asked - 1));
        }
}

/// Restitution of impacts whose first touch falls anywhere in a step: its mean and its scatter (one sigma).
struct Spread {
  double mean, scatter;
};
Spread restitution_spread(Law law, bool on_wall, double asked, int steps_per_contact) {
  constexpr int phases = 64;
  constexpr double speed = 0.1;
  double sum = 0, square = 0;
  for (int k = 0; k < phases; ++k) {
    Bench bench = two_lots(law);
    bench.scene.contact.seed.restitution = bench.scene.contact.wall.restitution = asked;
    const double dt = contact_time(bench, on_wall ? -1 : 0, speed) / steps_per_contact, phase = 8 + (k + 0.5) / phases;
    const ImpactResult impact =
        on_wall ? wall_impact(bench, speed, 0, dt, 0, phase) : head_on_impact(bench, speed, 0, dt, phase);
    const double measured = (on_wall ? impact.vy : impact.other_vx - impact.vx) / speed;
    sum += measured, square += measured * measured;
  }
  const double mean = sum / phases;
  return {mean, std::sqrt(std::max(0.0, square / phases - mean * mean))};
}

// At the steps that runs take: where in a step the first touch falls hardly tells.
TEST(Restitution, AtTheStepsOfRuns) {
  VerificationReport report(
      "restitution_at_few_steps",
      "restitution at few steps an elastic contact, velocity Verlet: mean and scatter (one sigma) over 64 moments of "
      "touch within a step",
      {"law", "against", "restitution_asked", "steps_per_contact", "mean", "deviation", "scatter"});
  const std::map<int, double> largest_scatter = {{8, 0.01}, {12, 0.005}, {20, 0.002}};
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const bool on_wall : {false, true})
      for (const double asked : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (const int steps : {8, 12, 20, 40}) {
          const Spread spread = restitution_spread(law, on_wall, asked, steps);
          const std::string name = law == Law::hertz ? "hertz" : "elastic_shell", against = on_wall ? "wall" : "grain";
          SCOPED_TRACE(testing::Message() << name << " " << against << " " << asked << " " << steps << " steps");
          report.add(name, against, asked, steps, spread.mean, spread.mean - asked, spread.scatter);
          if (asked == 0.5 && largest_scatter.count(steps)) {
            EXPECT_NEAR(spread.mean, asked, 0.01 * asked);
            EXPECT_LE(spread.scatter, largest_scatter.at(steps));
          }
          if (asked == 0.1 && steps >= 12) {
            EXPECT_NEAR(spread.mean, asked, 0.01);
            EXPECT_LE(spread.scatter, 0.01);
          }
        }
}

// Paper B: -gamma M v with Hertz' law; restitution and duration depend on gamma (M^2 / (k^2 V))^(1/5) alone. Ours ends
// where the force has fallen to zero; the column e_x0 is for a contact that may pull until the overlap is gone.
TEST(PaperBDamping, FollowsTheTable) {
  VerificationReport report(
      "hertz_viscous",
      "paper B's damping: a contact ends where its force has fallen to zero (F0); e_x0 is the table's "
      "restitution for the other end condition, overlap back to zero, which lets the contact pull",
      {"against", "speed_m_per_s", "reduced_damping", "e_F0_table", "e_x0_table", "restitution", "deviation_percent",
       "duration_F0_table", "duration", "duration_deviation_percent"});
  const DataTable table("hertz_const_damping_restitution.csv");
  ASSERT_EQ(table.rows(), 15u);
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const double reduced_damping = table.number(k, "ghat"), expected = table.number(k, "e_F0");
    const double expected_duration = table.number(k, "T_over_t0_F0");
    for (const bool on_wall : {false, true})
      for (const double speed : {0.01, 1.0}) {
        Bench bench;
        bench.hertz_ball(5e10, 0.2, 2500, 0.01);  // paper B's grains
        bench.scene.contact.law = Law::hertz_viscous;
        const double mass = bench.scene.lots[0].mass * (on_wall ? 1 : 0.5);
        const double modulus = 5e10 / (1 - 0.04) * (on_wall ? 1 : 0.5), radius = 0.01 * (on_wall ? 1 : 0.5);
        const double stiffness = 4.0 / 3 * modulus * std::sqrt(radius);
        const double unit = std::pow(mass * mass / (stiffness * stiffness * speed), 0.2);  // s
        bench.scene.contact.damping_rate = reduced_damping / unit;
        const double dt = unit / 4000;
        const ImpactResult impact = on_wall ? wall_impact(bench, speed, 0, dt) : head_on_impact(bench, speed, 0, dt);
        const double measured = (on_wall ? impact.vy : impact.other_vx - impact.vx) / speed;
        const double duration = (reduced_damping > 0 ? impact.force_duration : impact.duration) / unit;
        EXPECT_NEAR(measured, expected, 0.005 * expected) << "reduced damping " << reduced_damping;
        EXPECT_NEAR(duration, expected_duration, 0.005 * expected_duration) << "reduced damping " << reduced_damping;
        report.add(on_wall ? "wall" : "ball", speed, reduced_damping, expected, table.number(k, "e_x0"), measured,
                   100 * (measured / expected - 1), expected_duration, duration,
                   100 * (duration / expected_duration - 1));
      }
  }
}

// A falling grain bounces to h_n = r + (h_0 - r) e^(2 n), the first five bounces; stiff contacts keep the weight small
// against the contact force.
TEST(Restitution, BounceHeights) {
  VerificationReport report("bounces",
                            "first five bounces of a grain dropped from 50 mm above the floor, restitution 0.9",
                            {"law", "bounce", "height_theory_mm", "height_mm", "deviation_percent"});
  for (const Law law : {Law::elastic_shell, Law::hertz}) {
    Bench bench = two_lots(law);
    bench.gravity = {0, -standard_gravity};
    bench.scene.contact.shell_compression = 1e-7;
    bench.scene.contact.youngs_modulus = 1e10;
    bench.scene.contact.wall.restitution = 0.9;
    const double start = 0.05;
    bench.place(0.5, Bench::radius + start);
    Simulation& run = bench.start(contact_time(bench, -1, std::sqrt(2 * standard_gravity * start)) / 200);
    double expected = start;
    for (int bounce = 1; bounce <= 5; ++bounce) {
      while (run.grains().vy[0] <= 0) ASSERT_TRUE(run.step());
      while (run.grains().vy[0] > 0) ASSERT_TRUE(run.step());
      expected *= 0.9 * 0.9;
      const double height = run.grains().y[0] - Bench::radius;
      EXPECT_NEAR(height, expected, 0.005 * expected) << "bounce " << bounce;
      report.add(law == Law::hertz ? "hertz" : "elastic_shell", bounce, expected * 1e3, height * 1e3,
                 100 * (height / expected - 1));
    }
  }
}

}  // namespace
}  // namespace vibrosow
