#include "agronomy/sowing_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "scene/input_error.hpp"
#include "support/made_up_hole_table.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const HoleTable& table() {
  static const HoleTable made_up(made_up_records());
  return made_up;
}

/// Five materials that were predicted to a fifth or so.
const ModelError other_materials{0.2, 5, 1.1};

/// Balls of 4 mm and 40 mg in rows of 25 cm at 8 km/h.
SowingTask task_of(double seeds_per_s) {
  SowingTask task;
  task.seed = {4e-3, 40e-6, 1};
  task.pace = {0.25, 8 * kilometre_per_hour};
  task.sowing_rate = seeds_per_s * task.seed.mass / (task.pace.row_spacing * task.pace.speed);
  return task;
}

/// s, sqrt(d / g) of these seeds
const double unit = std::sqrt(4e-3 / standard_gravity);

TEST(SowingPlan, RapeseedsNeed) {
  SowingTask task;
  task.seed = {2e-3, 4.5e-6, 1};
  task.sowing_rate = 3.5 * kilogram_per_hectare;
  task.pace = {0.25, 8 * kilometre_per_hour};
  EXPECT_NEAR(task.row_mass_rate(), 0.1944e-3, 1e-7);
  EXPECT_NEAR(task.row_seed_rate(), 43.2, 0.05);
  EXPECT_NEAR(task.seeds_per_area(), 77.8, 0.05);
}

TEST(SowingPlan, EveryLayoutGivesTheRate) {
  const SowingTask task = task_of(100);
  const SowingPlan plan = plan_sowing(task, table(), other_materials);
  ASSERT_GT(plan.layouts.size(), 10U);
  std::set<std::pair<int, int>> feeds;
  for (const PlannedLayout& layout : plan.layouts) {
    const auto found = table().at({1, layout.width_over_d, layout.peak_speed, layout.depth_over_d});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->outflow / unit * layout.feed.holes / layout.feed.rows, 100, 1e-3);
    EXPECT_NEAR(layout.peak_speed,
                2 * std::numbers::pi * layout.frequency * layout.amplitude / std::sqrt(standard_gravity * 4e-3), 1e-9);
    EXPECT_GE(layout.frequency, 3);
    EXPECT_LE(layout.frequency, 25);
    EXPECT_NEAR(layout.amplitude, 8e-3, 1e-12);
    EXPECT_NEAR(std::round(layout.width / 0.5e-3) * 0.5e-3, layout.width, 1e-12);
    EXPECT_TRUE(layout.speeds.holds(task.pace.speed));
    feeds.emplace(layout.feed.holes, layout.feed.rows);
  }
  EXPECT_GT(feeds.size(), 3U);
}

TEST(SowingPlan, WiderHolesComeFirstThenThoseThatNeverStoodStill) {
  for (const double rate : {30.0, 100.0, 300.0, 1000.0}) {
    const SowingPlan plan = plan_sowing(task_of(rate), table(), other_materials);
    ASSERT_FALSE(plan.layouts.empty()) << rate;
    for (std::size_t i = 1; i < plan.layouts.size(); ++i) {
      const PlannedLayout &better = plan.layouts[i - 1], &worse = plan.layouts[i];
      EXPECT_LE(better.risk(), worse.risk());
      if (better.risk() != worse.risk()) continue;
      EXPECT_LE(better.estimate.stood_still, worse.estimate.stood_still);
      if (better.estimate.stood_still == worse.estimate.stood_still) {
        EXPECT_GE(better.reaches_working_speeds(), worse.reaches_working_speeds());
      }
    }
  }
}

TEST(SowingPlan, ClassesOfHoles) {
  EXPECT_EQ(hole_class(5), HoleClass::rarely_clogs);
  EXPECT_EQ(hole_class(4.99), HoleClass::kept_open);
  EXPECT_EQ(hole_class(3), HoleClass::kept_open);
  EXPECT_EQ(hole_class(2.99), HoleClass::clogs);
}

TEST(SowingPlan, SpeedsReachAsFarAsTheOutflowGoesOneWay) {
  const SowingTask task = task_of(100);
  for (const PlannedLayout& layout : plan_sowing(task, table(), other_materials).layouts) {
    // The law has its most at 1.4; the shaker's 3 Hz are 0.761.
    const double turn = made_up_outflow({1, layout.width_over_d, 1.4, layout.depth_over_d});
    const double end = made_up_outflow({1, layout.width_over_d, 3.8, layout.depth_over_d});
    const double wanted = 100 * unit * layout.feed.rows / layout.feed.holes;
    EXPECT_EQ(layout.more_by_faster, layout.peak_speed < 1.4);
    EXPECT_NEAR(layout.speeds.most / task.pace.speed, turn / wanted, 0.05 * turn / wanted);
    if (!layout.more_by_faster) {
      EXPECT_NEAR(layout.speeds.least / task.pace.speed, end / wanted, 0.05);
    }
  }
}

TEST(SowingPlan, NoFrequencyBeyondTheShakersLimits) {
  const SowingPlan plan =
      plan_sowing(task_of(100), table(), other_materials, {.least_frequency = 6, .most_frequency = 7});
  for (const PlannedLayout& layout : plan.layouts) {
    EXPECT_GE(layout.frequency, 6);
    EXPECT_LE(layout.frequency, 7);
  }
  const SowingPlan none =
      plan_sowing(task_of(100), table(), other_materials, {.least_frequency = 60, .most_frequency = 70});
  EXPECT_TRUE(none.layouts.empty());
  EXPECT_EQ(none.change.most_share, 0);
}

TEST(SowingPlan, TooLittleAndTooMuchAreToldAsShares) {
  const SowingPlan least = plan_sowing(task_of(0.5), table(), other_materials);
  EXPECT_TRUE(least.layouts.empty());
  EXPECT_GT(least.change.least_share, 1);
  // One hole of 2 d for four rows, in the shallow bed and shaken the fastest.
  EXPECT_NEAR(least.change.least_share, table().at({1, 2, 3.8, 3})->outflow / (4 * 0.5 * unit), 1e-9);
  const SowingPlan most = plan_sowing(task_of(1e5), table(), other_materials);
  EXPECT_TRUE(most.layouts.empty());
  EXPECT_LT(most.change.most_share, 1);
  EXPECT_GT(most.change.most_share, 0);
}

TEST(SowingPlan, RowsThatAWideHoleWouldHaveToFeed) {
  const NearestChange change = plan_sowing(task_of(10), table(), other_materials).change;
  ASSERT_TRUE(change.kept_open && change.rarely_clogs);
  EXPECT_NEAR(change.kept_open->width, 12e-3, 1e-12);
  EXPECT_NEAR(change.rarely_clogs->width, 20e-3, 1e-12);
  // The least that such a hole gives: in the shallow bed at the fastest shaking.
  const double slow = table().at({1, 3, 3.8, 3})->outflow, wide = table().at({1, 5, 3.8, 3})->outflow;
  EXPECT_EQ(change.kept_open->rows, static_cast<int>(std::ceil(slow / (10 * unit))));
  EXPECT_EQ(change.rarely_clogs->rows, static_cast<int>(std::ceil(wide / (10 * unit))));
}

TEST(SowingPlan, TheTableIsSureToChanceAndInterpolationAndSoftness) {
  const SowingPlan plan = plan_sowing(task_of(100), table(), other_materials);
  const PlannedLayout& best = plan.layouts.front();
  EXPECT_NEAR(
      plan.unknown_to_table(best),
      std::hypot(best.estimate.chance, table().interpolation_error(1, best.width_over_d, best.peak_speed)) + 0.055,
      1e-12);
  EXPECT_GT(plan.unknown_to_table(best), plan.softness);
}

TEST(SowingPlan, ARateErrsByFourParts) {
  const SowingPlan plan = plan_sowing(task_of(100), table(), other_materials);
  const PlannedLayout& best = plan.layouts.front();
  constexpr double normal_95 = 1.959964;
  EXPECT_NEAR(best.error.chance * normal_95, best.estimate.chance, 1e-12);
  EXPECT_NEAR(best.error.numerics * normal_95, std::hypot(best.interpolation, 0.055), 1e-12);
  EXPECT_EQ(best.error.model.scale, other_materials.scale);
  // By the made-up law the width counts as (width - 1)^(5/2), the speed as exp(-ln(speed / 1.4)^2 / 2).
  const double by_width = 2.5 * best.width_over_d / (best.width_over_d - 1) * 0.1e-3 / best.width;
  const double by_speed = -std::log(best.peak_speed / 1.4) * 0.02;
  EXPECT_NEAR(best.error.tolerance * normal_95, std::hypot(by_width, by_speed), 0.15 * by_width);
}

TEST(SowingPlan, LongSeedsHaveTheSoftnessErrorOfGrains) {
  EXPECT_DOUBLE_EQ(softness_error(1), 0.055);
  EXPECT_DOUBLE_EQ(softness_error(2.2), 0.073);
}

TEST(SowingPlan, WhatTheTableHardlyKnowsIsLeftOut) {
  std::vector<HoleRecord> records = made_up_records();
  for (HoleRecord& record : records)
    if (record.at.width >= 5) record.half_width_95 = 0.6 * record.outflow;
  const SowingPlan known = plan_sowing(task_of(300), table(), other_materials);
  const SowingPlan plan = plan_sowing(task_of(300), HoleTable(records), other_materials);
  EXPECT_EQ(known.too_uncertain, 0U);
  EXPECT_GT(plan.too_uncertain, 0U);
  EXPECT_EQ(plan.layouts.size() + plan.too_uncertain, known.layouts.size());
  for (const PlannedLayout& layout : plan.layouts) EXPECT_LE(plan.unknown_to_table(layout), most_uncertain);
}

TEST(SowingPlan, SeedsThatTheTableHasNot) {
  SowingTask task = task_of(100);
  task.seed.aspect = 2.7;
  EXPECT_THAT(
      [&] { plan_sowing(task, table(), other_materials); },
      ThrowsMessage<InputError>(HasSubstr("2.7 times as long as wide; the table of one hole knows seeds of 1 to 2")));
}

TEST(PlannedSeed, OfABallAndOfAClump) {
  SeedLot ball;
  ball.diameter = 4e-3;
  ball.mass = 40e-6;
  EXPECT_NEAR(planned_seed({ball}).diameter, 4e-3, 1e-15);
  EXPECT_EQ(planned_seed({ball}).aspect, 1);
  const PlannedSeed heavier = planned_seed({of_mass(ball, 8 * 40e-6)});
  EXPECT_NEAR(heavier.diameter, 8e-3, 1e-15) << "at equal density";
  EXPECT_NEAR(heavier.mass, 8 * 40e-6, 1e-18);
  SeedLot clump = ball;
  clump.shape = Shape::clump;
  clump.discs = {{-1e-3, 0, 1e-3, 0}, {1e-3, 0, 1e-3, 0}};
  EXPECT_NEAR(planned_seed({clump}).aspect, 2, 1e-12);
  EXPECT_NEAR(planned_seed({clump}).diameter, 2e-3 * std::cbrt(2), 1e-9) << "two balls that touch";
  EXPECT_NEAR(planned_seed({of_mass(clump, 8 * 40e-6)}).diameter, 4e-3 * std::cbrt(2), 1e-9);
}

TEST(PlannedSeed, SizesAreNotStretched) {
  SeedLot lot;
  lot.name = "mixed";
  lot.diameter = 4e-3;
  lot.mass = 40e-6;
  lot.sizes.kind = SizeDistribution::Kind::uniform;
  lot.sizes.least = 3e-3;
  lot.sizes.most = 5e-3;
  EXPECT_THAT([&] { of_mass(lot, 50e-6); }, ThrowsMessage<InputError>(HasSubstr("mixed: its seeds have sizes")));
}

/// 120 kg/ha of 40 mg and 90 kg/ha of 10 mg: three small ones for each large one.
TEST(Mixture, IsSharedOutByNumber) {
  std::vector<SownLot> sown(2);
  sown[0].lot.diameter = 4e-3, sown[0].lot.mass = 40e-6, sown[0].sowing_rate = 120 * kilogram_per_hectare;
  sown[1].lot.diameter = 2e-3, sown[1].lot.mass = 10e-6, sown[1].sowing_rate = 90 * kilogram_per_hectare;
  share_out(sown);
  EXPECT_NEAR(sown[0].seeds_per_area(), 300, 1e-9);
  EXPECT_NEAR(sown[1].seeds_per_area(), 900, 1e-9);
  EXPECT_NEAR(sown[0].lot.number_fraction, 0.25, 1e-12);
  EXPECT_NEAR(sown[1].lot.number_fraction, 0.75, 1e-12);
  // The rate by mass over the mean mass is the number of all.
  const PlannedSeed mean = planned_seed({sown[0].lot, sown[1].lot});
  EXPECT_NEAR(210 * kilogram_per_hectare / mean.mass, 1200, 1e-9);
}

/// The aspect of a mixture goes by volume: of balls and pairs of them that touch, as many of each, two thirds are
/// pairs.
TEST(Mixture, ItsAspectGoesByVolume) {
  SeedLot ball{.name = "ball", .diameter = 2e-3, .mass = 5e-6};
  SeedLot pair{.name = "pair", .diameter = 4e-3, .mass = 10e-6, .shape = Shape::clump};
  pair.discs = {{-1e-3, 0, 1e-3}, {1e-3, 0, 1e-3}};
  ball.number_fraction = pair.number_fraction = 0.5;
  EXPECT_NEAR(planned_seed({ball, pair}).aspect, (1 + 2 * 2) / 3.0, 1e-9);
}

/// A hole clogs by the largest crop: what is three mean seeds wide is not three of the largest.
TEST(Mixture, ItsHolesClogByTheLargestCrop) {
  SowingTask task = task_of(300);
  task.seed.largest = 8e-3;
  const SowingPlan mixed = plan_sowing(task, table(), other_materials);
  ASSERT_FALSE(mixed.layouts.empty());
  for (const PlannedLayout& layout : mixed.layouts) {
    EXPECT_NEAR(layout.width_over_largest, layout.width_over_d / 2, 1e-12);
    EXPECT_EQ(layout.risk(), hole_class(layout.width_over_d / 2));
  }
  const SowingPlan alone = plan_sowing(task_of(300), table(), other_materials);
  EXPECT_GT(mixed.layouts.front().risk(), alone.layouts.front().risk());
  if (mixed.change.kept_open) {
    EXPECT_NEAR(mixed.change.kept_open->width, 24e-3, 1e-12);
  }
}

/// That no hole stood still is known of the mean seed alone.
TEST(Mixture, OfHolesThatClogTheWidestComesFirst) {
  SowingTask task = task_of(300);
  task.seed.largest = 20e-3;
  const SowingPlan plan = plan_sowing(task, table(), other_materials);
  ASSERT_GT(plan.layouts.size(), 1u);
  for (std::size_t i = 1; i < plan.layouts.size(); ++i) {
    EXPECT_EQ(plan.layouts[i].risk(), HoleClass::clogs);
    EXPECT_GE(plan.layouts[i - 1].width, plan.layouts[i].width);
  }
}

TEST(SowingPlan, HolesFeedTheRowsThatADrillHas) {
  SowingTask task = task_of(300);
  const auto feeds_of = [&](int rows) {
    task.rows = rows;
    std::set<int> fed;
    for (const PlannedLayout& layout : plan_sowing(task, table(), other_materials).layouts)
      fed.insert(layout.feed.rows);
    return fed;
  };
  EXPECT_TRUE(std::ranges::includes(std::set{1, 2, 4}, feeds_of(20)));
  EXPECT_TRUE(std::ranges::includes(std::set{1}, feeds_of(1)));
  EXPECT_TRUE(feeds_of(0).contains(3)) << "a drill whose rows are not known";
}

}  // namespace
}  // namespace vibrosow
