// How a bed of clumps starts: nearly as it will lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/clump_shape.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "support/solid_clumps.hpp"

namespace vibrosow {
namespace {

/// Cylinders of 20 by 5 mm, in the tray's own height, at rest.
Scene bed_of_cylinders(int count) {
  Bench bench;
  bench.scene.lots.clear();
  std::vector<ClumpDisc> discs;
  for (int k = -3; k <= 3; ++k) discs.push_back({k * 2.5e-3, 0, 2.5e-3});
  bench.add_clump(discs, 4e-4);
  Scene scene = bench.scene;
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.length = 0.15;
  scene.tray.height = 0.2;
  scene.tray.fill = Fill{count, Packing::poured, 1e-3, false};
  scene.run.duration = 0.5;
  return scene;
}

/// Twice the mean height of the centres, m: of a level bed its height.
double height_of(const Grains& grains) {
  return 2 * std::accumulate(grains.y.begin(), grains.y.end(), 0.0) / static_cast<double>(grains.size());
}

/// A bed that is let go starts without overlap and settles, to no less than its height over `most`.
void expect_barely_settles(const Scene& scene, std::uint64_t random_seed, double most) {
  Simulation run(prepare(scene), random_seed);
  const double poured = height_of(run.grains());
  ASSERT_TRUE(run.step());
  EXPECT_LT(run.result().max_relative_overlap, 1e-3) << "nothing overlaps at the start";
  EXPECT_TRUE(run.run_until(scene.run.duration)) << *run.guard().stop_reason();
  EXPECT_EQ(run.result().status, RunStatus::finished);
  EXPECT_LT(run.result().energy.kinetic, 1e-3 * run.result().energy.potential) << "settled";
  EXPECT_LT(poured, most * height_of(run.grains()));
  EXPECT_GT(poured, height_of(run.grains()));
}

TEST(StartingState, ABedOfClumpsBarelySettles) {
  for (const std::uint64_t random_seed : {1u, 2u}) expect_barely_settles(bed_of_cylinders(150), random_seed, 1.25);
}

/// Wheat grains in a box in 3D.
Scene bed_of_wheat(int count) {
  Scene scene = clump_scene(wheat_grains(), 0.025);
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.height = 0.1;
  scene.tray.fill = Fill{count, Packing::poured, 1e-3, false};
  scene.run.duration = 0.2;
  return scene;
}

TEST(StartingState, ABedOfClumpsInSpaceBarelySettles) {
  expect_barely_settles(bed_of_wheat(250), 1, 1.1);
}

TEST(StartingState, SeedsSetOutAtRestOrWithTheirVessel) {
  for (const Space space : both_spaces)
    for (const Start start : {Start::at_rest, Start::with_tray}) {
      Scene scene = Bench(space).scene;
      scene.tray.length = 0.1;
      if (space == Space::three_dimensional) scene.tray.depth = 0.1;
      scene.tray.fill = Fill{20, Packing::layers, 0, false};
      scene.tray.motion = RockingMotion{{0, 0}, 0.1, 5};
      scene.run.start = start;
      const Grains g = starting_state(prepare(scene), 1).grains;
      ASSERT_EQ(g.size(), 20u);
      const double spin = start == Start::with_tray ? 0.1 * 2 * Bench::pi * 5 : 0;
      for (std::size_t i = 0; i < g.size(); ++i)
        EXPECT_LT((velocity_of(g, i) - spin * Eigen::Vector3d(-g.y[i], g.x[i], 0)).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace vibrosow
