// How far the energy of an elastic gas drifts in 1e8 steps, and how far it should: `long_runs [STEPS]`. CSV on stdout.
//
// A few grains without friction or gravity in a closed box, in 2D and in 3D. An impact changes the energy e
// of the motion along its normal by a fraction that depends on where in a step the two touch and, of two grains, on how
// far from head-on they do. Mean m and standard deviation s of that, weighed with e and e^2, are taken from single
// impacts at the same step: of a grain on a wall at 1000 places in a step, and of 50000 pairs that meet as in a gas of
// this energy. From impact to impact the places are as good as random, so that in a gas of energy E
//
//     ln E rises by  sum(m e/E)  plus or minus  sqrt(sum (s e/E)^2)
//
// and both sums are taken along the run, impact by impact, walls and pairs each with their own m and s; that m itself
// is known from so many impacts only widens the deviation. Of RK2 theory says m = (pi/4) z^3 for a head-on impact, z =
// omega dt. Verlet's map keeps the volume of phase space and is its own reverse: an impact gives nothing in the mean,
// but what diffuses in an energy of f degrees of freedom rises by f/4 of its variance, which is its expected drift
// here.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

constexpr double radius = 4e-3, mass = 0.6e-3;  // m, kg
constexpr double shell_compression = 1e-4;

/// Of a shell on a wall and of two alike on each other, rad/s.
double contact_frequency() {
  return std::sqrt(standard_gravity / (shell_compression * radius));
}

struct Gas {
  Space space;
  Integrator scheme;
  double steps_per_contact;

  bool is_3d() const { return space == Space::three_dimensional; }
  int dimensions() const { return is_3d() ? 3 : 2; }
  int grains() const { return is_3d() ? 8 : 6; }
  double side() const { return is_3d() ? 0.04 : 0.06; }  // m, of the box
  double z() const { return std::numbers::pi / steps_per_contact; }
  double step() const { return z() / contact_frequency(); }  // s
};

Model model_of(const Gas& gas) {
  Scene scene;
  scene.space = gas.space;
  scene.lots = {{"grain", 2 * radius, mass, gas.is_3d() ? Shape::ball : Shape::disc, 1}};
  scene.contact.shell_compression = shell_compression;
  scene.contact.seed = scene.contact.wall = {0, 1};
  scene.contact.rotation = false;
  Vessel& box = scene.tray;
  box.name = "tray";
  box.length = gas.side(), box.height = 2 * gas.side();
  if (gas.is_3d()) box.depth = gas.side();
  box.pieces = {{.a = {0, gas.side()}, .b = {gas.side(), gas.side()}}};
  scene.numerics.integrator = gas.scheme;
  scene.numerics.dt = gas.step(), scene.numerics.allow_long_step = true;
  scene.guard.energy_tolerance = 1e9;  // what the scheme makes is what is looked at
  scene.run.duration = 1;
  Model model = prepare(scene);
  model.gravity = {0, 0};
  return model;
}

Simulation started(const Model& model, const std::vector<Eigen::Vector3d>& places,
                   const std::vector<Eigen::Vector3d>& velocities) {
  Grains grains = no_grains(model);
  for (std::size_t i = 0; i < places.size(); ++i) grains.add(places[i], velocities[i], 0, grains.kinds.front());
  return Simulation(model, starting_state(model, 1, std::move(grains)));
}

double energy_of(Simulation& run) {
  return kinetic_energy(run.grains()) + run.field().elastic_energy();
}

double square(double value) {
  return value * value;
}

/// Relative change of the energy along the normal in an impact, as the file's head has it.
struct ErrorOfImpact {
  double mean, deviation;
  double uncertainty;  // of the mean, from so many impacts
};

/// Sums over impacts that are as frequent as their weights.
class ImpactSums {
 public:
  void add(double weight, double energy, double change) {
    energies_ += weight * energy, changes_ += weight * change;
    squares_ += weight * square(energy), squared_changes_ += weight * square(change);
    all_.push_back({weight, energy, change});
  }
  ErrorOfImpact error() const {
    const double mean = changes_ / energies_;
    double apart = 0;
    for (const auto& [weight, energy, change] : all_) apart += square(weight * (change - mean * energy));
    return {mean, std::sqrt(squared_changes_ / squares_ - square(mean)), std::sqrt(apart) / energies_};
  }

 private:
  double energies_ = 0, changes_ = 0, squares_ = 0, squared_changes_ = 0;
  std::vector<std::array<double, 3>> all_;
};

/// Runs an impact that begins within two steps to its end; what the energy became, less what it was.
double change_of_energy(const Gas& gas, Simulation& run) {
  const double before = energy_of(run);
  run.steps(std::llround(1.5 * gas.steps_per_contact) + 4);
  while (run.field().elastic_energy() > 0) run.step();
  return energy_of(run) - before;
}

ErrorOfImpact error_on_walls(const Gas& gas) {
  constexpr int places = 1000;
  constexpr double speed = 0.3;  // m/s; the law is linear
  const Model model = model_of(gas);
  ImpactSums sums;
  for (int k = 0; k < places; ++k) {
    const double above = (1 + (k + 0.5) / places) * speed * gas.step(), middle = 0.5 * gas.side();
    Simulation run = started(model, {{middle, radius + above, middle}}, {{0, -speed, 0}});
    sums.add(1, 0.5 * mass * square(speed), change_of_energy(gas, run));
  }
  return sums.error();
}

/// The relative velocity of two of the grains of a gas of this energy (J), each way as likely as any other.
Eigen::Vector3d relative_velocity(const Gas& gas, double energy, std::mt19937_64& random) {
  std::normal_distribution<double> any;
  std::vector<double> components(static_cast<std::size_t>(gas.dimensions() * gas.grains()));
  double squares = 0;
  for (double& one : components) one = any(random), squares += square(one);
  const double scale = std::sqrt(2 * energy / mass / squares);
  Eigen::Vector3d between = Eigen::Vector3d::Zero();
  for (int k = 0; k < gas.dimensions(); ++k)
    between[k] =
        scale * (components[static_cast<std::size_t>(k)] - components[static_cast<std::size_t>(gas.dimensions() + k)]);
  return between;
}

ErrorOfImpact error_of_pairs(const Gas& gas, double energy) {
  constexpr int impacts = 50000;
  const Model model = model_of(gas);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part;
  ImpactSums sums;
  for (int k = 0; k < impacts; ++k) {
    const Eigen::Vector3d velocity = relative_velocity(gas, energy, random);
    const double speed = velocity.norm(), turned = 2 * std::numbers::pi * part(random);
    // Aside of head-on, evenly over the width or the area that the two offer each other.
    const double aside = 2 * radius * (gas.is_3d() ? std::sqrt(part(random)) : part(random));
    Eigen::Vector3d across = velocity.unitOrthogonal();
    if (gas.is_3d())
      across = Eigen::AngleAxisd(turned, velocity / speed) * across;
    else
      across = Eigen::Vector3d(-velocity.y(), velocity.x(), 0) / speed;
    const double along = std::sqrt(square(2 * radius) - square(aside)) + (1 + part(random)) * speed * gas.step();
    const Eigen::Vector3d apart = aside * across - along * velocity / speed;
    const double middle = 0.5 * gas.side();
    Simulation run = started(
        model,
        {Eigen::Vector3d(middle, middle, middle) + 0.5 * apart, Eigen::Vector3d(middle, middle, middle) - 0.5 * apart},
        {0.5 * velocity, -0.5 * velocity});
    const double normal = 0.25 * mass * square(speed) * (1 - square(aside / (2 * radius)));
    sums.add(speed, normal, change_of_energy(gas, run));
  }
  return sums.error();
}

/// Notes impacts as they begin: the sums over e/E of the file's head.
class Impacts {
 public:
  explicit Impacts(const Gas& gas) : gas_(gas), n_(static_cast<std::size_t>(gas.grains())) {
    touching_.assign(n_ * (n_ - 1) / 2 + 2 * n_ * static_cast<std::size_t>(gas.dimensions()), 0);
  }

  void look(const Grains& g, double energy) {
    const std::array<const double*, 3> at = {g.x.data(), g.y.data(), g.z.data()},
                                       speed = {g.vx.data(), g.vy.data(), g.vz.data()};
    const std::size_t dimensions = static_cast<std::size_t>(gas_.dimensions());
    std::size_t contact = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t k = 0; k < dimensions; ++k) {
        const auto outwards = [&] { return speed[k][i]; };
        note(walls_, contact++, radius - at[k][i], mass, outwards, energy);
        note(walls_, contact++, at[k][i] - (gas_.side() - radius), mass, outwards, energy);
      }
      for (std::size_t j = 0; j < i; ++j) {
        double distance2 = 0;
        for (std::size_t k = 0; k < dimensions; ++k) distance2 += square(at[k][i] - at[k][j]);
        if (distance2 >= square(2 * radius)) {
          touching_[contact++] = 0;
          continue;
        }
        const double distance = std::sqrt(distance2);
        const auto approach = [&] {
          double along = 0;
          for (std::size_t k = 0; k < dimensions; ++k)
            along += (at[k][i] - at[k][j]) * (speed[k][i] - speed[k][j]) / distance;
          return along;
        };
        note(pairs_, contact++, 2 * radius - distance, 0.5 * mass, approach, energy);
      }
    }
  }

  std::int64_t count() const { return walls_.count + pairs_.count; }
  bool any() const { return std::ranges::find(touching_, 1) != touching_.end(); }
  /// Sums of e/E and of its square.
  struct Sums {
    std::int64_t count = 0;
    double parts = 0, squares = 0;
  };
  const Sums& on_walls() const { return walls_; }
  const Sums& of_pairs() const { return pairs_; }

 private:
  /// Where it begins, the energy along the normal is that of the approach and of what is pressed already.
  template <class Approach>
  void note(Sums& sums, std::size_t contact, double overlap, double reduced_mass, Approach approach, double energy) {
    const bool touches = overlap > 0;
    if (touches && !touching_[contact]) {
      const double omega = contact_frequency();
      const double part = 0.5 * reduced_mass * (square(approach()) + square(omega * overlap)) / energy;
      ++sums.count, sums.parts += part, sums.squares += square(part);
    }
    touching_[contact] = touches;
  }

  const Gas& gas_;
  std::size_t n_;
  std::vector<char> touching_;
  Sums walls_, pairs_;
};

Simulation started_gas(const Gas& gas, const Model& model) {
  std::vector<Eigen::Vector3d> places, velocities;
  const double apart = gas.side() / 3;
  for (int k = 0; k < gas.grains(); ++k) {
    const int row = gas.is_3d() ? 2 : 3;
    places.emplace_back(apart * (0.6 + k % row), apart * (0.7 + k / row % 2), apart * (0.8 + k / row / 2));
    velocities.emplace_back(0.3 * std::sin(1.7 * k + 1), -0.3 * std::cos(2.3 * k),
                            gas.is_3d() ? 0.3 * std::sin(2.9 * k + 1) : 0);
  }
  return started(model, places, velocities);
}

std::string name_of(const Gas& gas) {
  return fmt::format("{},{}", gas.is_3d() ? "space" : "plane",
                     gas.scheme == Integrator::rk2_midpoint ? "rk2_midpoint" : "velocity_verlet");
}

void follow(const Gas& gas, std::int64_t steps) {
  const bool midpoint = gas.scheme == Integrator::rk2_midpoint;
  const double theory = midpoint ? 0.25 * std::numbers::pi * std::pow(gas.z(), 3) : 0;
  const Model model = model_of(gas);
  Simulation run = started_gas(gas, model);
  const double at_first = energy_of(run), degrees = gas.dimensions() * gas.grains();
  const ErrorOfImpact on_wall = error_on_walls(gas), of_pair = error_of_pairs(gas, at_first);
  Impacts impacts(gas);
  double energy = at_first;
  std::int64_t next_row = 10000;
  bool is_due = false;
  for (std::int64_t step = 1; step <= steps || is_due; ++step) {
    if (!run.step()) {
      fmt::print(stderr, "long_runs: stopped: {}\n", *run.guard().stop_reason());
      std::exit(1);
    }
    if (step % 1000 == 0) energy = energy_of(run);
    impacts.look(run.grains(), energy);
    is_due |= step == next_row || step >= steps;
    if (!is_due || impacts.any()) continue;  // in the midst of an impact the energy swings
    is_due = false;
    next_row *= 10;
    const Impacts::Sums &walls = impacts.on_walls(), &pairs = impacts.of_pairs();
    double variance = square(on_wall.deviation) * walls.squares + square(of_pair.deviation) * pairs.squares;
    if (midpoint) variance += square(of_pair.uncertainty * pairs.parts);
    const double expected =
        midpoint ? on_wall.mean * walls.parts + of_pair.mean * pairs.parts : 0.25 * degrees * variance;
    const double change = std::log(energy_of(run) / at_first), deviation = std::sqrt(variance);
    fmt::print("{},{},{:g},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.2f}\n", name_of(gas),
               gas.grains(), gas.steps_per_contact, step, impacts.count(), theory, on_wall.mean, on_wall.deviation,
               of_pair.mean, of_pair.deviation, change, expected, deviation, (change - expected) / deviation);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace vibrosow

int main(int count, char** arguments) {
  using namespace vibrosow;
  const std::int64_t steps = count > 1 ? std::atoll(arguments[1]) : 100000000;
  fmt::print(
      "space,scheme,grains,steps_per_contact,steps,impacts,gain_by_theory,gain_on_wall,deviation_on_wall,gain_of_pair,"
      "deviation_of_pair,"
      "rise_of_log_energy,expected,deviation_expected,apart_in_deviations\n");
  for (const Space space : {Space::two_dimensional, Space::three_dimensional}) {
    follow({space, Integrator::velocity_verlet, 20}, steps);
    follow({space, Integrator::rk2_midpoint, 100}, steps);
  }
}
