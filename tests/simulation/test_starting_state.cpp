// How a bed of clumps starts: nearly as it will lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "scene/mixture.hpp"
#include "scene/seed_lot.hpp"
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

/// With a sieve's table: 30 % of the mass are of 1 mm, 30 % of 2 mm, and 40 % of 6 mm, which are few.
SeedLot sieved(SeedLot lot) {
  lot.sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {1e-3, 2e-3, 6e-3}, {0.3, 0.3, 0.4}};
  double number = 0;
  for (std::size_t k = 0; k < 3; ++k)
    number += lot.sizes.fraction[k] /= std::pow(lot.sizes.diameter[k] / lot.diameter, mass_power(lot));
  for (double& fraction : lot.sizes.fraction) fraction /= number;
  return lot;
}

Scene sieved_scene(Space space, bool clumps, Packing packing, int count) {
  Scene scene = Bench(space).scene;
  scene.lots = {{"grit", 1e-3, 1e-6}};
  if (clumps) {
    make_clump(scene.lots[0], elongated(2e-3, 1e-3), space);
  }
  scene.lots = {sieved(scene.lots[0])};
  scene.contact.shell_compression = 1e-3;
  scene.tray.length = scene.tray.height = 0.2;
  if (space == Space::three_dimensional) scene.tray.depth = 0.05;
  scene.tray.fill = Fill{count, packing, 1e-3, false};
  return scene;
}

TEST(StartingState, ASizeThatWasAskedForAndIsNotThereIsTold) {
  for (const Space space : both_spaces)
    for (const bool clumps : {false, true})
      for (const Packing packing : {Packing::poured, Packing::layers}) {
        const Scene scene = sieved_scene(space, clumps, packing, 60);
        const Model model = prepare(scene);
        SimulationState state = starting_state(model, 1);
        for (std::uint64_t random_seed = 2; size_shares(model.scene, state.run.drawn)[2].seeds > 0; ++random_seed)
          state = starting_state(model, random_seed);  // most of 60 seeds have none
        const std::vector<LotShare> sizes = size_shares(model.scene, state.run.drawn);
        ASSERT_EQ(sizes.size(), 3u);
        EXPECT_EQ(sizes[0].seeds + sizes[1].seeds + sizes[2].seeds, 60);
        EXPECT_NEAR(sizes[2].asked_mass, 0.4, 1e-12);
        const auto small = static_cast<double>(
            std::ranges::count_if(state.grains.radius, [](double radius) { return radius < 0.75e-3; }));
        EXPECT_EQ(sizes[0].seeds, small);
        const double mass = small * *std::ranges::min_element(state.grains.mass);
        EXPECT_NEAR(sizes[0].of_mass, mass / std::accumulate(state.grains.mass.begin(), state.grains.mass.end(), 0.0),
                    1e-12);
        const std::vector<Doubt> told = Simulation(model, state).result().warnings;
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told.back().kind, DoubtKind::sizes_drawn);
        EXPECT_THAT(told.back().text,
                    testing::StartsWith("tray.fill.count: none of the seeds of grit is of 6 mm: 0 % "));
        EXPECT_THAT(told.back().text, testing::HasSubstr("0 % by mass instead of 40 %"));
      }
}

TEST(StartingState, ManySeedsAreOfTheSizesAskedFor) {
  Scene scene = sieved_scene(Space::two_dimensional, false, Packing::layers, 1000);
  scene.lots[0].sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {3e-3, 4e-3, 5e-3}, {0.3, 0.4, 0.3}};
  EXPECT_THAT(drawn_warnings(scene, starting_state(prepare(scene), 1).run.drawn), testing::IsEmpty());
}

TEST(StartingState, TheMassOfALotInAMixtureIsOfTheSeedsDrawn) {
  Scene scene = sieved_scene(Space::two_dimensional, false, Packing::layers, 60);
  scene.lots[0].number_fraction = 0.5;
  scene.lots.push_back({"pea", 6e-3, 1e-4, Shape::ball, 0.5});
  const SimulationState state = starting_state(prepare(scene), 1);
  double grit = 0, all = 0;
  for (std::size_t i = 0; i < state.grains.size(); ++i)
    all += state.grains.mass[i], grit += state.grains.lot[i] == 0 ? state.grains.mass[i] : 0;
  EXPECT_NEAR(lot_shares(scene, state.run.drawn)[0].of_mass, grit / all, 1e-12);
  EXPECT_GT(off_by(lot_shares(scene, state.run.drawn)[0]), far_off);
  EXPECT_LT(off_by(lot_shares(scene)[0]), 1e-12) << "of mean seeds";
  EXPECT_THAT(drawn_warnings(scene, state.run.drawn),
              testing::Contains(testing::HasSubstr("the 30 seeds of grit are lighter or heavier than its mean seed")));
}

}  // namespace
}  // namespace vibrosow
