// Balls in 3D, step by step: like the plane where all happens in one, whichever scheme, threads and instructions,
// and across periodic boundaries.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <vector>

#include "scene/input_error.hpp"
#include "simulation/simulation.hpp"
#include "support/bench.hpp"
#include "support/same_bits.hpp"

namespace vibrosow {
namespace {

constexpr double radius = 2e-3;

Scene box(Space space) {
  Scene scene;
  scene.space = space;
  scene.lots = {{"ball", 2 * radius, 4e-5, Shape::ball, 1}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.seed = scene.contact.wall = {0.4, 0.6, 0.1, 0};
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.rolling = Rolling::spring;
  scene.tray.name = "tray";
  scene.tray.length = 0.03, scene.tray.height = 0.05, scene.tray.depth = 0.026;
  scene.run.duration = 0.3;
  return scene;
}

struct Ball {
  Eigen::Vector3d at, velocity;
};

Grains grains_of(const Model& model, const std::vector<Ball>& balls) {
  Grains grains = no_grains(model);
  for (const Ball& ball : balls) {
    if (grains.is_3d)
      grains.add(ball.at, ball.velocity, 0, grains.kinds.front());
    else
      grains.add(ball.at.x(), ball.at.y(), ball.velocity.x(), ball.velocity.y(), 0);
  }
  return grains;
}

SimulationState start_of(const Model& model, const std::vector<Ball>& balls) {
  return starting_state(model, 1, grains_of(model, balls));
}

/// A loose heap: layers, each a little aside of the one below, none touching.
std::vector<Ball> heap(int along, int up, int across) {
  std::vector<Ball> balls;
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < along; ++i)
      for (int k = 0; k < across; ++k)
        balls.push_back(
            {{0.003 + 0.0045 * i + 0.0011 * (j % 3), 0.003 + 0.0045 * j, 0.003 + 0.0045 * k + 0.0007 * (j % 2)},
             {0.02 * (i % 2), 0, 0.03 * (k % 3)}});
  return balls;
}

class EveryScheme : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Space, EveryScheme,
                         testing::Values(Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5));

TEST_P(EveryScheme, InThePlaneItIsThePlane) {
  // Thrown against floor, end wall and each other, in the plane z = 13 mm.
  const std::vector<Ball> balls = {{{0.005, 0.004, 0.013}, {0.3, -0.1, 0}},
                                   {{0.012, 0.0041, 0.013}, {-0.2, 0, 0}},
                                   {{0.026, 0.01, 0.013}, {0.1, -0.3, 0}}};
  std::vector<Grains> ends;
  for (const Space space : {Space::two_dimensional, Space::three_dimensional}) {
    Scene scene = box(space);
    scene.numerics.integrator = GetParam();
    const Model model = with_step(prepare(scene), 2e-6);
    Simulation run(model, start_of(model, balls));
    run.steps(30000);
    ends.push_back(run.grains());
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_NEAR(ends[1].x[i], ends[0].x[i], 1e-9);
    EXPECT_NEAR(ends[1].y[i], ends[0].y[i], 1e-9);
    EXPECT_NEAR(ends[1].omega[i], ends[0].omega[i], 1e-6 * std::abs(ends[0].omega[i]) + 1e-6);
    EXPECT_NEAR(ends[1].z[i], 0.013, 1e-15);
    EXPECT_GT(std::abs(ends[0].omega[i]), 1);
  }
}

TEST_P(EveryScheme, AHeapSettlesAndLosesNone) {
  Scene scene = box(Space::three_dimensional);
  scene.numerics.integrator = GetParam();
  const Model model = prepare_to_run(scene);
  Simulation run(model, start_of(model, heap(5, 4, 5)));
  EXPECT_TRUE(run.run_until(0.3));
  const vibrosow::Run result = run.result();
  EXPECT_EQ(result.balance.inside, 100);
  EXPECT_EQ(result.balance.lost, 0);
  EXPECT_THAT(result.warnings, testing::IsEmpty());
  EXPECT_LT(result.energy.kinetic, 2e-8);  // fallen from 9 mm on average: 100 x 3.5e-6 J
  EXPECT_GT(result.energy.elastic, 0);
}

TEST(Space, ThreadsAndInstructionsChangeNoBit) {
  const Model model = prepare_to_run(box(Space::three_dimensional));
  std::vector<std::vector<double>> ends;
  for (const InstructionSet set : instruction_sets)
    for (const int threads : {1, 3}) {
      if (!is_available(set)) continue;
      ComputeOptions options;
      options.instructions = set, options.threads = threads;
      Simulation run(model, start_of(model, heap(5, 4, 5)), options);
      run.run_until(0.05);
      ends.push_back(bits(run.grains()));
    }
  for (const auto& end : ends) EXPECT_EQ(end, ends.front());
}

TEST(Space, ListsChangeNoBit) {
  const Model model = prepare_to_run(box(Space::three_dimensional));
  std::vector<std::vector<double>> ends;
  for (const NeighbourMargins margins :
       {NeighbourMargins{}, NeighbourMargins{2, 0.02, 0.5}, NeighbourMargins{2, 0.3, 2}}) {
    ComputeOptions options;
    options.margins = margins;
    Simulation run(model, start_of(model, heap(5, 4, 5)), options);
    run.run_until(0.05);
    ends.push_back(bits(run.grains()));
  }
  for (const auto& end : ends) EXPECT_EQ(end, ends.front());
}

TEST(Space, APeriodIsNowhere) {
  Scene scene = box(Space::three_dimensional);
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  const Model model = prepare_to_run(scene);
  std::vector<Ball> balls = heap(6, 3, 5), moved = balls;
  for (Ball& ball : moved) {
    ball.at += Eigen::Vector3d(0.015, 0, 0.013);
    if (ball.at.x() > 0.03) ball.at.x() -= 0.03;
    if (ball.at.z() > 0.026) ball.at.z() -= 0.026;
  }
  Simulation here(model, start_of(model, balls)), there(model, start_of(model, moved));
  here.run_until(0.03), there.run_until(0.03);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_NEAR(here.grains().y[i], there.grains().y[i], 1e-9);
    EXPECT_NEAR(std::remainder(here.grains().x[i] + 0.015 - there.grains().x[i], 0.03), 0, 1e-9);
    EXPECT_NEAR(std::remainder(here.grains().z[i] + 0.013 - there.grains().z[i], 0.026), 0, 1e-9);
    EXPECT_NEAR(here.grains().omega_x[i], there.grains().omega_x[i], 1e-4);
  }
  EXPECT_GT(here.result().force_evaluations, 1000);
}

TEST(Space, ACutRunGoesOnToTheSameBits) {
  for (const Integrator scheme : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
    for (const Sides sides : {Sides::walls, Sides::periodic}) {
      Scene scene = box(Space::three_dimensional);
      scene.numerics.integrator = scheme;
      scene.tray.sides = scene.tray.front_and_back = sides;
      scene.tray.motion = HarmonicMotion{.direction = 0.3, .amplitude = 2e-3, .frequency = 15, .across = 0.5};
      const Model model = prepare_to_run(scene);
      expect_a_cut_run_goes_on(model, start_of(model, heap(5, 4, 5)), 0.02, 0.04, 100);
    }
}

TEST(Space, AShakenTrayCarriesItsBallsAcross) {
  Scene scene = box(Space::three_dimensional);
  scene.contact.wall.friction = 10;
  scene.tray.motion = HarmonicMotion{.amplitude = 1e-3, .frequency = 5, .across = 3.14159265358979323846 / 2};
  const Model model = prepare_to_run(scene);
  Simulation run(model, start_of(model, {{{0.015, radius, 0.013}, {0, 0, 0}}}));
  run.run_until(0.05);
  EXPECT_NEAR(run.grains().x[0], 0.015, 1e-12);
  EXPECT_GT(run.grains().z[0], 0.0132);  // a ball that rolls follows by 2/7
}

TEST(Space, TwistingBrakesABallThatSpinsOnTheSpot) {
  constexpr double twisting = 0.02, spin = 20, until = 0.05;  // rad/s, s
  for (const Rolling kind : {Rolling::constant_torque, Rolling::spring}) {
    Scene scene = box(Space::three_dimensional);
    scene.contact.rolling = kind;
    scene.contact.wall.twisting_friction = twisting;
    scene.contact.slip_speed = 1e-4;
    const Model model = prepare_to_run(scene);
    SimulationState state =
        start_of(model, {{{0.015, radius * (1 - scene.contact.shell_compression), 0.013}, {0, 0, 0}}});
    state.grains.omega_y[0] = spin;
    Simulation run(model, std::move(state));
    run.run_until(until);
    // The torque mu r m g against the inertia 2/5 m r^2.
    const double braked = 2.5 * twisting * standard_gravity / radius * run.time();
    EXPECT_NEAR(run.grains().omega_y[0], spin - braked, 0.005 * braked);
    EXPECT_NEAR(run.grains().x[0], 0.015, 1e-9);
  }
}

TEST(Space, AVesselWithoutADepthIsRefused) {
  Scene scene = box(Space::three_dimensional);
  scene.tray.depth.reset();
  EXPECT_THROW(prepare(scene), InputError);
}

TEST(Space, FrictionOneAndHardlyAnyReboundFallSilent) {
  Scene scene = box(Space::three_dimensional);
  scene.contact.seed = scene.contact.wall = {1, 0.1, 0.1, 0};
  scene.run.duration = 0.5;
  const Model model = prepare_to_run(scene);
  Simulation run(model, start_of(model, heap(5, 5, 5)));
  EXPECT_TRUE(run.run_until(0.5));
  // A ball may go on spinning about an upright axis: nothing resists twisting here.
  const Grains& g = run.grains();
  for (std::size_t i = 0; i < g.size(); ++i)
    EXPECT_LT(std::hypot(g.vx[i], g.vy[i], g.vz[i]) + radius * std::hypot(g.omega_x[i], g.omega[i]), 1e-5);
  EXPECT_THAT(run.result().warnings, testing::IsEmpty());
}

TEST(RoundFloor, WhatFallsBesideItIsSpilled) {
  Bench bench(Space::three_dimensional);
  bench.scene.tray.plan = Plan::round;
  bench.scene.tray.holes = {{.centre = 0.3, .width = 0.05, .shape = HoleShape::round, .across = 0.5}};
  bench.gravity = {0, -standard_gravity};
  bench.place({0.05, 0.01, 0.05}).place({0.97, 0.01, 0.93}).place({0.15, 0.01, 0.5}).place({0.3, 0.01, 0.5});
  Simulation& run = bench.start(1e-5);
  run.steps(20000);
  const vibrosow::Run result = run.result();
  EXPECT_EQ(result.balance.spilled, 2) << "where a square would reach beyond the wall";
  EXPECT_EQ(result.balance.counted, 1) << "through the hole";
  EXPECT_EQ(result.balance.inside, 1);
}

}  // namespace
}  // namespace vibrosow
