// Grains that swing on the springs of rolling and twisting: how fast, how damped, and their energy in the account.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

constexpr double rolling = 0.03, twisting = 0.02;  // coefficients, of the rolling radius
constexpr double weight = Bench::mass * standard_gravity, compression = 1e-4 * Bench::radius;  // N, m
constexpr double stiffness_on_wall = weight / compression;                                     // N/m

/// A way to swing on a spring about a contact.
struct Swing {
  std::string name;
  Space space;
  std::function<void(Bench&, double spin)> place;  // rad/s
  std::function<double(const Grains&)> spin;       // the same now
  double stiffness, inertia;                       // N m / rad of relative angle, kg m2
  double damping_inertia;                          // kg m2, which the critical damping goes by
};

double inertia_of(Space space) {
  return (space == Space::two_dimensional ? 0.5 : 0.4) * Bench::mass * Bench::radius * Bench::radius;
}
double about_contact(Space space) {
  return inertia_of(space) + Bench::mass * Bench::radius * Bench::radius;
}

/// 9/4 k (mu_r R)^2 (Ai et al. 2011).
double spring(double coefficient, double normal_stiffness, double rolling_radius) {
  const double arm = coefficient * rolling_radius;
  return 2.25 * normal_stiffness * arm * arm;
}

std::vector<Swing> swings() {
  constexpr double r = Bench::radius, arm = r - compression;
  const auto on_wall = [](double coefficient) { return spring(coefficient, stiffness_on_wall, r); };
  const auto of_pair = [](double coefficient) { return spring(coefficient, 0.5 * stiffness_on_wall, 0.5 * r); };
  std::vector<Swing> all;
  // Rolls on the floor: to the left where it turns anticlockwise; in 3D towards the front.
  all.push_back({"rolling on a floor", Space::two_dimensional,
                 [=](Bench& bench, double spin) { bench.place(0.5, arm, -spin * arm, 0, spin); },
                 [](const Grains& g) { return g.omega[0]; }, on_wall(rolling), about_contact(Space::two_dimensional),
                 about_contact(Space::two_dimensional)});
  all.push_back({"rolling across a floor", Space::three_dimensional,
                 [=](Bench& bench, double spin) {
                   bench.place({0.5, arm, 0.5}, {0, 0, spin * arm}, {spin, 0, 0});
                 },
                 [](const Grains& g) { return g.omega_x[0]; }, on_wall(rolling),
                 about_contact(Space::three_dimensional), about_contact(Space::three_dimensional)});
  all.push_back({"twisting on a floor", Space::three_dimensional,
                 [=](Bench& bench, double spin) {
                   bench.place({0.5, arm, 0.5}, Eigen::Vector3d::Zero(), {0, spin, 0});
                 },
                 [](const Grains& g) { return g.omega_y[0]; }, on_wall(twisting), inertia_of(Space::three_dimensional),
                 inertia_of(Space::three_dimensional)});
  // Two that cohere and turn against each other on the spot: the angle between them grows by twice the spin.
  for (const Space space : both_spaces)
    all.push_back({space == Space::two_dimensional ? "rolling on each other" : "rolling on each other in space", space,
                   [=](Bench& bench, double spin) {
                     bench.place({0.5, 0.5, 0.5}, Eigen::Vector3d::Zero(), {0, 0, spin})
                         .place({0.5 + 2 * r - compression, 0.5, 0.5}, Eigen::Vector3d::Zero(), {0, 0, -spin});
                   },
                   [](const Grains& g) { return g.omega[0]; }, of_pair(rolling), 0.5 * inertia_of(space),
                   0.5 * about_contact(space)});
  all.push_back({"twisting on each other", Space::three_dimensional,
                 [=](Bench& bench, double spin) {
                   bench.place({0.5, 0.5, 0.5}, Eigen::Vector3d::Zero(), {spin, 0, 0})
                       .place({0.5 + 2 * r - compression, 0.5, 0.5}, Eigen::Vector3d::Zero(), {-spin, 0, 0});
                 },
                 [](const Grains& g) { return g.omega_x[0]; }, of_pair(twisting),
                 0.5 * inertia_of(Space::three_dimensional), 0.5 * inertia_of(Space::three_dimensional)});
  return all;
}

/// What a swing was like from its start to the third time that it stood still.
struct Swung {
  double omega;          // rad/s
  double later;          // spin after a time, over that at the start
  double energy_change;  // the largest, over the swing's own
};

Swung swung(const Swing& swing, double damping, double later_at) {
  Bench bench(swing.space);
  Contact& contact = bench.scene.contact;
  const bool alone = swing.name.find("floor") != std::string::npos;
  if (alone) bench.gravity = {0, -standard_gravity};
  contact.seed = contact.wall = {.friction = 1,
                                 .restitution = 1,
                                 .rolling_friction = rolling,
                                 .cohesion = alone ? 0 : 0.5 * weight,
                                 .twisting_friction = twisting};
  contact.friction_model = FrictionModel::spring, contact.rolling = Rolling::spring;
  contact.rolling_damping = damping;
  const double omega = std::sqrt(swing.stiffness / swing.inertia);
  const double coefficient = swing.name.find("twisting") != std::string::npos ? twisting : rolling;
  const double largest_torque = coefficient * Bench::radius * weight * (alone ? 1 : 0.25);  // N m
  const double spin = 0.3 * largest_torque / swing.stiffness * omega / (alone ? 1 : 2), dt = 1e-5;
  swing.place(bench, spin);
  Simulation& run = bench.start(dt);
  const auto energy = [&] {
    return kinetic_energy(run.grains()) + potential_energy(run.grains(), bench.gravity) + run.field().elastic_energy();
  };
  const double at_first = energy(), kinetic = kinetic_energy(run.grains());
  Swung result{0, 0, 0};
  double before = spin, first_stop = 0;
  for (int stops = 0; stops < 3 && run.time() < 20 / omega;) {
    if (!run.step()) {
      ADD_FAILURE() << *run.guard().stop_reason();
      break;
    }
    const double now = swing.spin(run.grains());
    result.energy_change = std::max(result.energy_change, std::abs(energy() - at_first) / kinetic);
    if (run.time() < later_at + 0.5 * dt) result.later = now / spin;
    if (before * now < 0) {
      const double stop = run.time() - dt * now / (now - before);
      if (++stops == 1) first_stop = stop;
      if (stops == 3) result.omega = 2 * Bench::pi / (stop - first_stop);
    }
    before = now;
  }
  return result;
}

TEST(SpringsOfRolling, SwingAtTheirFrequencyAndKeepTheirEnergyInTheAccount) {
  for (const Swing& swing : swings()) {
    SCOPED_TRACE(swing.name);
    const Swung free = swung(swing, 0, 0);
    const double omega = std::sqrt(swing.stiffness / swing.inertia);
    EXPECT_NEAR(free.omega, omega, 0.005 * omega);
    EXPECT_LT(free.energy_change, 0.01);
  }
}

TEST(SpringsOfRolling, AreDampedByTheirFractionOfCritical) {
  constexpr double fraction = 0.1;
  for (const Swing& swing : swings()) {
    SCOPED_TRACE(swing.name);
    const double ratio = fraction * std::sqrt(swing.damping_inertia / swing.inertia);
    const double omega = std::sqrt(swing.stiffness / swing.inertia);
    const double period = 2 * Bench::pi / (omega * std::sqrt(1 - ratio * ratio));  // s
    EXPECT_NEAR(swung(swing, fraction, period).later / std::exp(-ratio * omega * period), 1, 0.02);
  }
}

}  // namespace
}  // namespace vibrosow
