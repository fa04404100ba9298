// Clumps of balls in 3D as they move: free, on springs, in heaps, cut and taken up again.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "grains/clump_discs.hpp"
#include "grains/size_distribution.hpp"
#include "grains/turning_clump.hpp"
#include "scene/input_error.hpp"
#include "support/bench.hpp"
#include "support/same_bits.hpp"
#include "support/solid_clumps.hpp"

namespace vibrosow {
namespace {

constexpr Integrator every_scheme[] = {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5};

Eigen::Vector3d angular_momentum(const Grains& g, std::size_t i) {
  const Vector3 momentum = turning_clump(g, i).momentum_of(spin_of(g, i));
  return {momentum.x, momentum.y, momentum.z};
}

// What contacts see of a clump.

/// Its discs, in 3D balls, when it has moved on freely for `time`.
Grains discs_after(double time, Grains clump, ClumpDiscs& discs) {
  clump.x[0] += time * clump.vx[0], clump.y[0] += time * clump.vy[0];
  if (clump.is_3d) {
    clump.z[0] += time * clump.vz[0];
    const Eigen::Vector3d spin = turning_of(clump, 0), half = 0.5 * time * spin;
    const Eigen::Vector3d axis = std::sin(half.norm()) * spin.normalized() * (time < 0 ? -1 : 1);
    clump.set_orientation(0, Orientation{std::cos(half.norm()), axis.x(), axis.y(), axis.z()} * clump.orientation(0));
  } else {
    clump.angle[0] += time * clump.omega[0];
  }
  Execution execution;
  discs.place(clump, execution);
  Grains placed = discs.discs();
  for (std::size_t k = 0; clump.is_3d && k < placed.size(); ++k) {
    const GrainVector& velocity = discs.motions()[k].velocity;
    placed.vx[k] = velocity.x, placed.vy[k] = velocity.y, placed.vz[k] = velocity.z;
  }
  return placed;
}

void expect_speeds_of_places(const Model& model, const Grains& clump) {
  ClumpDiscs discs(model.scene.lots, model.kinds, *model.law, true);
  discs.rebuild(clump);
  constexpr double dt = 1e-6, tolerance = 1e-7;  // s, m/s
  const Grains now = discs_after(0, clump, discs), before = discs_after(-dt, clump, discs),
               after = discs_after(dt, clump, discs);
  ASSERT_EQ(now.size(), 2u);
  for (std::size_t k = 0; k < now.size(); ++k) {
    EXPECT_NEAR(now.vx[k], (after.x[k] - before.x[k]) / (2 * dt), tolerance);
    EXPECT_NEAR(now.vy[k], (after.y[k] - before.y[k]) / (2 * dt), tolerance);
    if (clump.is_3d) {
      EXPECT_NEAR(now.vz[k], (after.z[k] - before.z[k]) / (2 * dt), tolerance);
    }
  }
}

TEST(Clumps3d, DiscsAreAsFastAsTheirPlacesMove) {
  Scene scene = clump_scene(solid_lot({{-1e-3, 0.4e-3, 1e-3, 0.3e-3}, {1.2e-3, 0, 0.8e-3, -0.5e-3}}, 1e-3));
  scene.contact.seed.friction = 0.3;
  const Model is_3d = prepare(scene);
  const PlacedClump turned{{0.5, 0.5, 0.5}, {0.1, -0.2, 0.3}, {20, -30, 25}, {0.8, 0.3, -0.4, 0.2}};
  expect_speeds_of_places(is_3d, start_of(is_3d, {turned}).grains);

  scene.space = Space::two_dimensional;
  scene.tray.depth.reset();
  scene.lots[0] = {"clump", 0, 1e-3, Shape::clump, 1};
  make_clump(scene.lots[0], {{-1e-3, 0.4e-3, 1e-3}, {1.2e-3, 0, 0.8e-3}}, Space::two_dimensional);
  const Model in_plane = prepare(scene);
  Grains clump = no_grains(in_plane);
  clump.add(0.5, 0.5, 0.1, -0.2, 0);
  clump.omega[0] = 25, clump.angle[0] = 0.7;
  expect_speeds_of_places(in_plane, clump);
}

// A clump that nothing touches.

/// Principal moments 1 : 2 : 3, spinning about its middle axis, which no spin stays with: it turns over.
SeedLot unstable_lot() {
  SeedLot lot = solid_lot({{0, 0, 2e-3}}, 1e-3);
  lot.gyration2_x = 1e-6, lot.gyration2_y = 2e-6, lot.gyration2 = 3e-6;
  return lot;
}
const PlacedClump unstable_spin{{0.5, 0.5, 0.5}, {0, 0, 0}, {0.02, 20, 0.01}};

/// Euler's equations of the same clump by Odeint, its own axes: quaternion and spin after `time`.
struct Euler {
  Orientation orientation;
  Eigen::Vector3d spin;  // in the lab

  explicit Euler(double time) {
    using State = std::array<double, 7>;
    State state = {1, 0, 0, 0, unstable_spin.spin.x(), unstable_spin.spin.y(), unstable_spin.spin.z()};
    const auto rates = [](const State& s, State& rate, double) {
      const Orientation q = Orientation{s[0], s[1], s[2], s[3]} * Orientation{0, s[4] / 2, s[5] / 2, s[6] / 2};
      rate = {
          q.w, q.x, q.y, q.z, (2.0 - 3) / 1 * s[5] * s[6], (3.0 - 1) / 2 * s[6] * s[4], (1.0 - 2) / 3 * s[4] * s[5]};
    };
    namespace odeint = boost::numeric::odeint;
    odeint::integrate_adaptive(odeint::make_controlled(1e-14, 1e-14, odeint::runge_kutta_fehlberg78<State>()), rates,
                               state, 0.0, time, 1e-4);
    orientation = {state[0], state[1], state[2], state[3]};
    spin = rotation_matrix(orientation) * Eigen::Vector3d(state[4], state[5], state[6]);
  }
};

struct FreeFlight {
  double spin_error = 0, axes_error = 0, energy_error = 0, momentum_error = 0;  // all relative
  double middle_axis_up = 1;                                                    // the least

  FreeFlight(Integrator scheme, double dt, double time) {
    Scene scene = clump_scene(unstable_lot());
    scene.numerics.integrator = scheme;
    Model model = with_step(prepare(scene), dt);
    model.gravity = {0, 0};
    Simulation run(model, start_of(model, {unstable_spin}));
    const double energy = kinetic_energy(run.grains());
    const Eigen::Vector3d momentum = angular_momentum(run.grains(), 0);
    for (std::int64_t step = 0; step < std::llround(time / dt); ++step) {
      EXPECT_TRUE(run.step());
      middle_axis_up = std::min(middle_axis_up, rotation_matrix(run.grains().orientation(0))(1, 1));
      energy_error = std::max(energy_error, std::abs(kinetic_energy(run.grains()) / energy - 1));
      momentum_error =
          std::max(momentum_error, (angular_momentum(run.grains(), 0) - momentum).norm() / momentum.norm());
    }
    const Euler exact(time);
    const Grains& g = run.grains();
    spin_error = (turning_of(g, 0) - exact.spin).norm() / exact.spin.norm();
    axes_error = (rotation_matrix(g.orientation(0)) - rotation_matrix(exact.orientation)).norm();
    const Orientation q = g.orientation(0);
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 1e-15);
  }
};

TEST(Clumps3d, TheFlipOfTheMiddleAxisIsEulers) {
  for (const auto& [scheme, order] :
       {std::pair(every_scheme[0], 2), std::pair(every_scheme[1], 2), std::pair(every_scheme[2], 5)}) {
    constexpr double time = 1.2;
    const FreeFlight coarse(scheme, 4e-4, time), fine(scheme, 2e-4, time);
    EXPECT_LT(coarse.middle_axis_up, -0.95) << "it has turned over";
    const double spin_order = std::log2(coarse.spin_error / fine.spin_error);
    const double axes_order = std::log2(coarse.axes_error / fine.axes_error);
    SCOPED_TRACE(testing::Message() << "scheme " << static_cast<int>(scheme) << ": spin " << coarse.spin_error << ", "
                                    << fine.spin_error << " of order " << spin_order << "; axes " << coarse.axes_error
                                    << ", " << fine.axes_error << " of order " << axes_order);
    EXPECT_GT(spin_order, order - 0.15);
    EXPECT_GT(axes_order, order - 0.15);
    EXPECT_LT(fine.spin_error, 2e-3);
  }
}

TEST(Clumps3d, FreeOnesKeepEnergyAndAngularMomentum) {
  for (const Integrator scheme : every_scheme) {
    const bool gear = scheme == Integrator::gear5;
    const double dt = gear ? 16e-4 : 4e-4;  // finer, and Gear's error is lost in rounding
    const FreeFlight coarse(scheme, dt, 0.8), fine(scheme, 0.5 * dt, 0.8);
    SCOPED_TRACE(testing::Message() << "scheme " << static_cast<int>(scheme) << ": energy " << coarse.energy_error
                                    << ", " << fine.energy_error << "; momentum " << coarse.momentum_error << ", "
                                    << fine.momentum_error);
    EXPECT_LT(fine.energy_error, gear ? 1e-9 : 1e-5);
    EXPECT_GT(std::log2(coarse.energy_error / fine.energy_error), gear ? 4.5 : 1.9);
    EXPECT_LT(fine.momentum_error, gear ? 1e-9 : 1e-12);
  }
  // Verlet's energy swings, and does not drift.
  EXPECT_LT(FreeFlight(Integrator::velocity_verlet, 4e-4, 40).energy_error,
            1.05 * FreeFlight(Integrator::velocity_verlet, 4e-4, 8).energy_error);
}

// On springs.

/// Lies on three of its balls, pressed down by its weight, and rocks: nothing parts, all is smooth.
std::vector<double> rocking_state(Integrator scheme, double dt, double time) {
  const std::vector<ClumpDisc> balls = {{0, 0, 3e-3}, {9e-3, 0, 3e-3}, {2e-3, 0, 3e-3, 8e-3}, {3e-3, 4e-3, 4e-3, 3e-3}};
  SeedLot lot = solid_lot(balls, 1e-3);
  Scene scene = clump_scene(lot);
  scene.contact.shell_compression = 1e-3;
  scene.numerics.integrator = scheme;
  const Model model = with_step(prepare(scene), dt);
  // As given: the axes of the principal frame follow from where three of the balls came to stand.
  const auto frame = [&](const std::vector<ClumpDisc>& b) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = centre_of(b[static_cast<std::size_t>(i) + 1]) - centre_of(b[0]);
    return edges;
  };
  const Eigen::Matrix3d r = frame(balls) * frame(lot.discs).inverse();
  const double w = 0.5 * std::sqrt(1 + r.trace());
  const Orientation q{w, (r(2, 1) - r(1, 2)) / (4 * w), (r(0, 2) - r(2, 0)) / (4 * w), (r(1, 0) - r(0, 1)) / (4 * w)};
  const Eigen::Vector3d first = rotation_matrix(of_unit_length(q)) * centre_of(lot.discs[0]);
  const PlacedClump clump{{0.5, 3e-3 - 1e-6 - first.y(), 0.5}, {0, 1e-4, 0}, {0.02, 0.5, 0.01}, q};
  Simulation run(model, start_of(model, {clump}));
  run.steps(std::llround(time / dt));
  EXPECT_GT(run.statistics().contacts, 2.9 * time / dt);
  const Grains& g = run.grains();
  return {g.x[0], g.y[0], g.z[0], 1e-2 * g.q_w[0], 1e-2 * g.q_x[0], 1e-2 * g.q_y[0], 1e-2 * g.q_z[0]};
}

TEST(Clumps3d, OnThreeBallsTheyRockToTheSchemesOrder) {
  for (const Integrator scheme : every_scheme) {
    std::array<std::vector<double>, 3> ends;
    for (std::size_t k = 0; k < 3; ++k) ends[k] = rocking_state(scheme, 4e-5 / static_cast<double>(1 << k), 0.04);
    double coarse = 0, fine = 0;
    for (std::size_t n = 0; n < ends[0].size(); ++n)
      coarse = std::max(coarse, std::abs(ends[1][n] - ends[0][n])),
      fine = std::max(fine, std::abs(ends[2][n] - ends[1][n]));
    const double order = std::log2(coarse / fine);
    EXPECT_GT(order, scheme == Integrator::gear5 ? 3.8 : 1.9)
        << static_cast<int>(scheme) << ": " << coarse << " " << fine;
  }
}

TEST(Clumps3d, CollidingOnesKeepTheirMomenta) {
  for (const bool loses : {false, true})
    for (const FrictionModel friction : {FrictionModel::sliding, FrictionModel::spring}) {
      Scene scene = clump_scene(solid_lot(odd_balls(), 1e-3));
      if (loses) scene.contact.seed = {0.4, 0.6};
      scene.contact.friction_model = friction;
      Model model = with_step(prepare(scene), 1e-6);
      model.gravity = {0, 0};
      const std::vector<PlacedClump> clumps = {
          {{0.48, 0.5, 0.5}, {0.3, 0.02, 0}, {30, 5, -10}, {1, 0.2, 0.5, 0.1}},
          {{0.52, 0.502, 0.503}, {-0.2, 0, 0.01}, {-10, 0, 20}, {0.3, 0.2, -0.5, 0.9}}};
      Simulation run(model, start_of(model, clumps));
      const auto momenta = [&] {
        const Grains& g = run.grains();
        Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < 2; ++i) {
          const Eigen::Vector3d p = 1e-3 * Eigen::Vector3d(g.vx[i], g.vy[i], g.vz[i]);
          momentum += p;
          angular += Eigen::Vector3d(g.x[i], g.y[i], g.z[i]).cross(p) + angular_momentum(g, i);
        }
        return std::pair(momentum, angular);
      };
      const auto [momentum, angular] = momenta();
      const double energy = kinetic_energy(run.grains());
      run.steps(150000);
      ASSERT_GT(run.statistics().contacts, 100);
      EXPECT_NEAR((momenta().first - momentum).norm(), 0, 1e-12 * 1e-3);
      EXPECT_NEAR((momenta().second - angular).norm(), 0, 1e-9 * 1e-3 * 0.3 * 0.01);
      if (loses)
        EXPECT_LT(kinetic_energy(run.grains()), 0.99 * energy);
      else
        EXPECT_NEAR(kinetic_energy(run.grains()), energy, 1e-5 * energy);
    }
}

TEST(Clumps3d, OneOfOneBallIsTheBall) {
  for (const Integrator scheme : every_scheme)
    for (const FrictionModel friction : {FrictionModel::sliding, FrictionModel::spring}) {
      const auto trajectory = [&](bool clump) {
        Scene scene = clump_scene(solid_lot({{0, 0, 4e-3}}, 1e-3));
        if (!clump) scene.lots = {{"ball", 8e-3, 1e-3, Shape::ball, 1}};
        scene.contact.seed = scene.contact.wall = {0.3, 0.7};
        scene.contact.friction_model = friction;
        scene.contact.drag = 1e-4;
        scene.numerics.integrator = scheme;
        const Model model = with_step(prepare(scene), 2e-5);
        Simulation run(model, start_of(model, {{{0.3, 0.01, 0.5}, {0.3, 0, 0.1}, {3, -8, 10}},
                                               {{0.305, 0.02, 0.502}},
                                               {{0.302, 0.03, 0.499}, {0, -0.5, 0}}}));
        run.steps(3000);
        EXPECT_GT(run.statistics().contacts, 100);
        return run.grains();
      };
      const Grains ball = trajectory(false), clump = trajectory(true);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(clump.x[i], ball.x[i], 1e-12);
        EXPECT_NEAR(clump.y[i], ball.y[i], 1e-12);
        EXPECT_NEAR(clump.z[i], ball.z[i], 1e-12);
        EXPECT_NEAR((turning_of(clump, i) - turning_of(ball, i)).norm(), 0, 1e-9);
        EXPECT_GT(turning_of(ball, i).norm(), 1);
      }
    }
}

// Many.

Scene heap_scene(const SeedLot& lot) {
  Scene scene = clump_scene(lot, 0.05);
  scene.contact.seed = scene.contact.wall = {0.4, 0.5};
  scene.contact.seed.rolling_friction = scene.contact.wall.rolling_friction = 0.1;
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.rolling = Rolling::spring;
  scene.run.duration = 0.5;
  return scene;
}

/// A loose heap, each turned at random, none touching.
std::vector<PlacedClump> heap_of(const SeedLot& lot, int along, int up, int across) {
  std::vector<PlacedClump> clumps;
  Random random(7);
  const double cell = 1.02 * lot.diameter;
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < along; ++i)
      for (int k = 0; k < across; ++k)
        clumps.push_back({cell * Eigen::Vector3d(0.6 + i, 0.6 + j, 0.6 + k),
                          {0.02 * (i % 2), 0, 0.03 * (k % 3)},
                          {1.0 * (k % 2), 2.0 * (i % 3), -1.0},
                          draw_orientation(random)});
  return clumps;
}

SeedLot dipole_lot() {
  return solid_lot(dipole(4e-3, 5e-3), 8e-5);
}

vibrosow::Run settled(const SeedLot& lot, Integrator scheme, double time) {
  Scene scene = heap_scene(lot);
  scene.contact.seed.restitution = scene.contact.wall.restitution = 0.3;
  scene.numerics.integrator = scheme;
  const Model model = prepare_to_run(scene);
  Simulation run(model, start_of(model, heap_of(lot, 3, 2, 3)));
  EXPECT_TRUE(run.run_until(time));
  vibrosow::Run result = run.result();
  EXPECT_EQ(result.balance.inside, 18);
  EXPECT_EQ(result.balance.lost, 0);
  EXPECT_THAT(result.warnings, testing::IsEmpty());
  EXPECT_GT(result.energy.elastic, 0);
  return result;
}

TEST(Clumps3d, AHeapOfDipolesSettlesSilent) {
  const SeedLot lot = dipole_lot();
  for (const Integrator scheme : every_scheme)
    EXPECT_LT(settled(lot, scheme, 0.4).energy.kinetic, 1e-6 * 18 * lot.mass * standard_gravity * lot.diameter)
        << static_cast<int>(scheme);
}

/// They may go on turning on their bellies: nothing resists twisting here.
TEST(Clumps3d, AHeapOfFlatSeedsLosesItsFall) {
  const SeedLot lot = solid_lot(elongated_solid(6e-3, 4e-3, 3e-3), 3e-5);
  EXPECT_LT(settled(lot, Integrator::velocity_verlet, 0.2).energy.kinetic,
            0.01 * 18 * lot.mass * standard_gravity * lot.diameter);
}

TEST(Clumps3d, ThreadsInstructionsAndListsChangeNoBit) {
  const Model model = prepare_to_run(heap_scene(dipole_lot()));
  std::vector<std::vector<double>> ends;
  for (const InstructionSet set : instruction_sets)
    for (const int threads : {1, 3})
      for (const NeighbourMargins margins : {NeighbourMargins{}, NeighbourMargins{2, 0.02, 0.5}}) {
        if (!is_available(set)) continue;
        ComputeOptions options;
        options.instructions = set, options.threads = threads, options.margins = margins;
        Simulation run(model, start_of(model, heap_of(dipole_lot(), 4, 3, 4)), options);
        run.run_until(0.04);
        ends.push_back(bits(run.grains()));
      }
  for (const auto& end : ends) EXPECT_EQ(end, ends.front());
}

TEST(Clumps3d, ACutRunGoesOnToTheSameBits) {
  for (const Integrator scheme : every_scheme)
    for (const Sides sides : {Sides::walls, Sides::periodic}) {
      Scene scene = heap_scene(dipole_lot());
      scene.numerics.integrator = scheme;
      scene.tray.sides = scene.tray.front_and_back = sides;
      scene.tray.motion = HarmonicMotion{.direction = 0.3, .amplitude = 2e-3, .frequency = 15, .across = 0.5};
      const Model model = prepare_to_run(scene);
      expect_a_cut_run_goes_on(model, start_of(model, heap_of(dipole_lot(), 4, 3, 4)), 0.02, 0.04, 100);
    }
}

TEST(Clumps3d, APeriodIsNowhere) {
  Scene scene = heap_scene(dipole_lot());
  scene.tray.length = 0.04, scene.tray.depth = 0.04;
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  const Model model = prepare_to_run(scene);
  std::vector<PlacedClump> clumps = heap_of(dipole_lot(), 4, 2, 4), moved = clumps;
  for (PlacedClump& clump : moved) {
    clump.at += Eigen::Vector3d(0.02, 0, 0.013);
    if (clump.at.x() > 0.04) clump.at.x() -= 0.04;
    if (clump.at.z() > 0.04) clump.at.z() -= 0.04;
  }
  Simulation here(model, start_of(model, clumps)), there(model, start_of(model, moved));
  here.run_until(0.03), there.run_until(0.03);
  for (std::size_t i = 0; i < clumps.size(); ++i) {
    EXPECT_NEAR(here.grains().y[i], there.grains().y[i], 1e-9);
    EXPECT_NEAR(std::remainder(here.grains().x[i] + 0.02 - there.grains().x[i], 0.04), 0, 1e-9);
    EXPECT_NEAR(here.grains().q_w[i], there.grains().q_w[i], 1e-6);
  }
  EXPECT_GT(here.result().force_evaluations, 100);
}

TEST(Clumps3d, KeptFromTurningTheyLieAsTheyDid) {
  Scene scene = heap_scene(dipole_lot());
  scene.contact.rotation = false;
  const Model model = prepare_to_run(scene);
  const std::vector<PlacedClump> clumps = heap_of(dipole_lot(), 4, 2, 4);
  Simulation run(model, start_of(model, clumps));
  const Grains before = run.grains();
  EXPECT_TRUE(run.run_until(0.1));
  EXPECT_GT(run.result().force_evaluations, 100);
  for (std::size_t i = 0; i < clumps.size(); ++i) EXPECT_EQ(run.grains().orientation(i), before.orientation(i));
}

TEST(Clumps3d, NeedTheInertiaOfTheirSpace) {
  Scene scene = clump_scene(dipole_lot());
  scene.lots[0].gyration2_x = 0;
  EXPECT_THROW(prepare(scene), InputError);
  scene = clump_scene(dipole_lot());
  scene.space = Space::two_dimensional;
  EXPECT_THROW(prepare(scene), InputError);
}

}  // namespace
}  // namespace vibrosow
