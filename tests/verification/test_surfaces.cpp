// Cohesion, and surfaces that differ from pair to pair.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow {
namespace {

constexpr double modulus = 1e8, poisson = 0.3;

double hertz_stiffness() {
  return 4.0 / 3 * modulus / (1 - poisson * poisson) * std::sqrt(Bench::radius);
}

double shell_stiffness() {
  return Bench::mass * standard_gravity / (1e-4 * Bench::radius);
}

Bench cohesive(Law law, double cohesion) {
  Bench bench;
  bench.scene.contact.law = law;
  bench.scene.contact.youngs_modulus = modulus;
  bench.scene.contact.poisson_ratio = poisson;
  bench.scene.contact.wall.cohesion = cohesion;
  return bench;
}

double overlap_at(Law law, double force) {
  return law == Law::hertz ? std::pow(force / hertz_stiffness(), 2.0 / 3) : force / shell_stiffness();
}

// Turned upside down the floor is a ceiling: a grain hangs from it where the cohesion is more than its weight. Its
// repulsion is then what the cohesion has over the weight; the largest pull it bears is the cohesion itself.
TEST(Cohesion, AGrainHangsFromTheCeilingUpToItsPull) {
  VerificationReport report("cohesion_hanging", "a grain under a ceiling, cohesion over its weight",
                            {"law", "cohesion_over_weight", "hangs", "overlap_theory_um", "overlap_um"});
  const double weight = Bench::mass * standard_gravity;
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const double over_weight : {0.5, 0.99, 1.01, 1.5, 3.0}) {
      Bench bench = cohesive(law, over_weight * weight);
      bench.gravity = {0, standard_gravity};
      bench.scene.contact.wall.restitution = 0.3;
      const double rest = over_weight > 1 ? overlap_at(law, (over_weight - 1) * weight) : 0;
      bench.place(0.5, Bench::radius - (over_weight > 1 ? 1.2 * rest : overlap_at(law, 1e-4 * weight)));
      Simulation& run = bench.start(1e-6);
      run.steps(100000);
      const double overlap = Bench::radius - run.grains().y[0];
      SCOPED_TRACE(over_weight);
      EXPECT_EQ(overlap > 0, over_weight > 1);
      if (over_weight > 1) {
        EXPECT_NEAR(overlap, rest, 1e-6 * rest);
        EXPECT_NEAR(run.grains().vy[0], 0, 1e-9);
      } else {
        EXPECT_GT(run.grains().vy[0], 0.9 * standard_gravity * 0.05);
      }
      report.add(law == Law::hertz ? "hertz" : "elastic_shell", over_weight, overlap > 0 ? "yes" : "no",
                 over_weight > 1 ? rest * 1e6 : std::nan(""), overlap > 0 ? overlap * 1e6 : std::nan(""));
    }
}

// An elastic cohesive impact: what the pull gives at touch it takes back at parting. The largest overlap follows from
// m v^2 / 2 + C d = elastic energy.
TEST(Cohesion, ElasticImpactKeepsItsEnergy) {
  VerificationReport report("cohesion_impact", "elastic impact on a cohesive wall at 0.1 m/s",
                            {"law", "cohesion_N", "speed_after_over_before", "overlap_theory_um", "overlap_um",
                             "largest_energy_change_over_kinetic"});
  const double speed = 0.1, kinetic = 0.5 * Bench::mass * speed * speed;
  for (const Law law : {Law::elastic_shell, Law::hertz}) {
    const double peak_force = law == Law::hertz ? HertzImpact(Bench::mass, hertz_stiffness(), speed).force
                                                : speed * std::sqrt(shell_stiffness() * Bench::mass);
    for (const double fraction : {0.0, 0.1, 0.5}) {
      const double cohesion = fraction * peak_force;
      double low = 0, high = 1e-3;  // m
      for (int k = 0; k < 100; ++k) {
        const double d = 0.5 * (low + high);
        const double elastic =
            law == Law::hertz ? 0.4 * hertz_stiffness() * std::pow(d, 2.5) : 0.5 * shell_stiffness() * d * d;
        (elastic < kinetic + cohesion * d ? low : high) = d;
      }
      Bench bench = cohesive(law, cohesion);
      const double dt = 1e-7;
      bench.place(0.5, Bench::radius + 2.37 * speed * dt, 0, -speed);
      Simulation& run = bench.start(dt);
      double deepest = 0, changed = 0;
      while (run.grains().vy[0] <= 0 || run.grains().y[0] < Bench::radius) {
        ASSERT_TRUE(run.step());
        deepest = std::max(deepest, Bench::radius - run.grains().y[0]);
        const double energy = kinetic_energy(run.grains()) + run.field().elastic_energy();
        changed = std::max(changed, std::abs(energy / kinetic - 1));
      }
      EXPECT_NEAR(run.grains().vy[0], speed, 0.001 * speed);
      EXPECT_NEAR(deepest, low, 0.001 * low);
      EXPECT_LT(changed, 0.002);
      report.add(law == Law::hertz ? "hertz" : "elastic_shell", cohesion, run.grains().vy[0] / speed, low * 1e6,
                 deepest * 1e6, changed);
    }
  }
}

/// Three lots of the same grain; a and b, and b and the walls, have surfaces of their own.
Bench three_lots(Law law) {
  Bench bench;
  bench.scene.lots = {{"a", 2 * Bench::radius, Bench::mass, Shape::ball, 0.4},
                      {"b", 2 * Bench::radius, Bench::mass, Shape::ball, 0.3},
                      {"c", 2 * Bench::radius, Bench::mass, Shape::ball, 0.3}};
  Contact& contact = bench.scene.contact;
  contact.law = law;
  contact.youngs_modulus = modulus;
  contact.poisson_ratio = poisson;
  contact.rolling = Rolling::constant_torque;
  contact.seed = {0.3, 0.9, 0.02, 1e-4};
  contact.wall = {0.4, 0.8, 0.03, 2e-4};
  contact.overrides = {{0, 1, {0.1, 0.5, 0.05, 5e-4}}, {1, -1, {0.2, 0.6, 0.07, 7e-4}}};
  return bench;
}

struct Felt {
  double friction, rolling_friction, cohesion;
};

/// What two grains of these lots (or one and the floor, other = -1) do to each other at an overlap, from the forces.
Felt felt(Law law, int lot, int other) {
  Bench bench = three_lots(law);
  bench.scene.contact.seed.restitution = bench.scene.contact.wall.restitution = 1;
  for (SurfaceOverride& o : bench.scene.contact.overrides) o.surface.restitution = 1;
  const double overlap = 1e-5;
  double k = 0;
  if (other < 0) {
    bench.place(0.5, Bench::radius - overlap, 1, 0, -100, lot);  // slides, and turns clockwise
    k = law == Law::hertz ? hertz_stiffness() * std::sqrt(overlap) : shell_stiffness();
  } else {
    bench.place(0.5, 0.5, 0, -1, 100, lot).place(0.5 + 2 * Bench::radius - overlap, 0.5, 0, 0, 0, other);
    // Two of the same in series: half the modulus and half the radius.
    k = law == Law::hertz ? 0.5 * std::sqrt(0.5) * hertz_stiffness() * std::sqrt(overlap) : 0.5 * shell_stiffness();
  }
  Simulation& run = bench.start(1e-9);
  const Forces& f = run.field().forces();
  const double repulsion = k * overlap, normal = other < 0 ? f[0].fy : -f[0].fx;
  const double tangential = other < 0 ? -f[0].fx : f[0].fy, arm = Bench::radius - (other < 0 ? 1 : 0.5) * overlap;
  const double rolling = f[0].torque + (other < 0 ? 1 : -1) * arm * tangential;
  const double rolling_radius = other < 0 ? Bench::radius : 0.5 * Bench::radius;
  return {std::abs(tangential) / repulsion, std::abs(rolling) / (repulsion * rolling_radius), repulsion - normal};
}

double restitution(Law law, int lot, int other) {
  Bench bench = three_lots(law);
  bench.scene.contact.seed.cohesion = bench.scene.contact.wall.cohesion = 0;
  for (SurfaceOverride& o : bench.scene.contact.overrides) o.surface.cohesion = 0;
  const double speed = 0.1, dt = 1e-7;
  if (other < 0)
    bench.place(0.5, Bench::radius + 2 * speed * dt, 0, -speed, 0, lot);
  else
    bench.place(0.5, 0.5, speed, 0, 0, lot).place(0.5 + 2 * Bench::radius + 2 * speed * dt, 0.5, 0, 0, 0, other);
  Simulation& run = bench.start(dt);
  run.steps(20000);
  const Grains& g = run.grains();
  return (other < 0 ? g.vy[0] : g.vx[1] - g.vx[0]) / speed;
}

// An override acts on its pair, whichever comes first, and on no other.
TEST(PairMaterials, ActOnTheirPairAlone) {
  VerificationReport report("pair_materials",
                            "surfaces by pair of lots: friction, rolling friction, cohesion (N) and "
                            "restitution, given and found",
                            {"law", "pair", "friction_given", "friction", "rolling_friction_given", "rolling_friction",
                             "cohesion_given_N", "cohesion_N", "restitution_given", "restitution"});
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (int lot = 0; lot < 3; ++lot)
      for (int other = -1; other < 3; ++other) {
        const Contact contact = three_lots(law).scene.contact;
        const bool is_ab = lot + other == 1 && other >= 0 && lot != other, is_b_wall = lot == 1 && other == -1;
        const Surface given = is_ab       ? contact.overrides[0].surface
                              : is_b_wall ? contact.overrides[1].surface
                              : other < 0 ? contact.wall
                                          : contact.seed;
        const std::string pair = std::string(1, static_cast<char>('a' + lot)) + "-" +
                                 (other < 0 ? "wall" : std::string(1, static_cast<char>('a' + other)));
        SCOPED_TRACE(pair);
        const Felt f = felt(law, lot, other);
        const double e = restitution(law, lot, other);
        EXPECT_NEAR(f.friction, given.friction, 1e-9);
        EXPECT_NEAR(f.rolling_friction, given.rolling_friction, 1e-9);
        EXPECT_NEAR(f.cohesion, given.cohesion, 1e-9 * given.cohesion + 1e-12);
        EXPECT_NEAR(e, given.restitution, 0.005 * given.restitution);
        report.add(law == Law::hertz ? "hertz" : "elastic_shell", pair, given.friction, f.friction,
                   given.rolling_friction, f.rolling_friction, given.cohesion, f.cohesion, given.restitution, e);
      }
}

}  // namespace
}  // namespace vibrosow
