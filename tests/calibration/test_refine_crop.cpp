#include "calibration/refine_crop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../fields/made_up_bed.hpp"
#include "scene/input_error.hpp"
#include "support/made_up_atlas.hpp"
#include "support/runs_on_demand.hpp"

namespace vibrosow::refine_crop_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

NewCrop crop_of(double length, double width) {
  NewCrop crop;
  crop.length = length, crop.width = crop.thickness = width;
  crop.mass = 1200 * std::numbers::pi / 6 * length * width * width;
  crop.angle_of_repose = 25 * degree;
  return crop;
}

std::vector<RefiningRun> runs_of(const NewCrop& crop, int count) {
  const ShippedAtlas atlas = plain_atlas();
  return refining_runs(crop, estimate(crop, atlas), atlas, count);
}

/// Balls in columns, level when filled and at `angle` when drained.
Run made_up_run(const Model& model, const SimulationOptions&, double angle) {
  const Vessel& box = model.scene.tray;
  const double left = box.holes[0].centre - 0.5 * box.holes[0].width, right = left + box.holes[0].width;
  constexpr double radius = 2e-3;
  Snapshot filled, drained;
  for (double y = radius; y < 0.06; y += 2 * radius)
    for (double z = radius; z < *box.depth; z += 2 * radius)
      for (double x = radius; x < box.length; x += 2 * radius) {
        put_ball(filled, {x, y, z}, {0, 0, 0}, 0, radius);
        const double beside = x < left ? left - x : x - right;
        if (beside > 0 && y < beside * std::tan(angle)) put_ball(drained, {x, y, z}, {0, 0, 0}, 0, radius);
      }
  Run run;
  run.status = RunStatus::finished;
  run.snapshots = {filled, drained};
  for (int k = 0; k < 500; ++k) run.events.push_back({0.4 + 1e-3 * k, 1, 0, k, 3e-5, 0.08, 1});
  return run;
}

TEST(RefineCrop, RunsAreOfTheBand3d) {
  const std::vector<RefiningRun> runs = runs_of(crop_of(2e-3, 2e-3), 5);
  ASSERT_EQ(runs.size(), 5u);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Scene& scene = runs[k].scene;
    EXPECT_EQ(runs[k].random_seed, k + 1);
    EXPECT_EQ(scene.space, Space::three_dimensional);
    EXPECT_TRUE(scene.lots[0].discs.empty()) << "balls";
    EXPECT_EQ(scene.contact.wall.friction, scene.contact.seed.friction);
    if (k > 0) {
      EXPECT_GT(scene.contact.seed.friction, runs[k - 1].scene.contact.seed.friction);
    }
  }
}

TEST(RefineCrop, SeedsHaveTheCropsShapeAndTheBallsVolume) {
  const NewCrop crop = crop_of(6e-3, 3e-3);
  const Scene scene = runs_of(crop, 3)[0].scene;
  ASSERT_EQ(scene.lots.size(), 3u);
  EXPECT_FALSE(scene.lots[1].discs.empty());
  EXPECT_NEAR(scene.lots[1].diameter, 4e-3 * std::pow(2, 2.0 / 3), 1e-5) << "length";
  EXPECT_NEAR(*scene.tray.depth / 28e-3, scene.tray.fill->count / 4200.0, 1e-3) << "filled as high as of balls";
  EXPECT_NEAR(scene.lots[2].diameter / scene.lots[0].diameter, 4.6 / 3.4, 1e-4);
}

KeptRuns on_demand(const std::vector<RefiningRun>& runs, const Simulator& simulator) {
  std::vector<WantedRun> wanted;
  for (const RefiningRun& run : runs)
    wanted.push_back({&run.scene, run.random_seed, name_of_run(run.scene, run.random_seed)});
  return runs_on_demand(wanted, simulator);
}

TEST(RefineCrop, WhatTheyStandAtTakesThePlaceOfTheFourMaterials) {
  const ShippedAtlas atlas = plain_atlas();
  const std::vector<RefiningRun> runs = runs_of(crop_of(2e-3, 2e-3), 3);
  const auto offset_at = [&](double angle) {
    const PlaneToSpace own = refined_to_space(
        atlas.atlas, runs, on_demand(runs, [angle](const Model& model, const SimulationOptions& options) {
          return made_up_run(model, options, angle);
        }));
    EXPECT_TRUE(own.of_the_crop);
    EXPECT_EQ(own.materials, 3);
    return own.angle_offset.mean;
  };
  EXPECT_NEAR((offset_at(35 * degree) - offset_at(25 * degree)) / degree, 10, 1.5) << "of stairs of balls";
}

TEST(RefineCrop, RunsThatFailedOrCloggedDoNotCount) {
  const ShippedAtlas atlas = plain_atlas();
  const std::vector<RefiningRun> runs = runs_of(crop_of(2e-3, 2e-3), 4);
  const auto fails_from = [](std::uint64_t first) {
    return [first](const Model& model, const SimulationOptions& options) {
      vibrosow::Run run = made_up_run(model, options, 30 * degree);
      if (options.random_seed == first) run.status = RunStatus::stopped_by_guard;
      if (options.random_seed > first) run.snapshots.back() = run.snapshots.front();
      return run;
    };
  };
  EXPECT_EQ(refined_to_space(atlas.atlas, runs, on_demand(runs, fails_from(4))).materials, 3);
  EXPECT_THAT([&] { refined_to_space(atlas.atlas, runs, on_demand(runs, fails_from(3))); },
              ThrowsMessage<InputError>(HasSubstr("at least 3")));
}

}  // namespace
}  // namespace vibrosow::refine_crop_test
