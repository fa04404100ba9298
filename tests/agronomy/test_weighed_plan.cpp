#include "agronomy/weighed_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scene/input_error.hpp"
#include "support/made_up_hole_table.hpp"
#include "support/table_tray_scene.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class Weighed : public testing::Test {
 protected:
  WeighedTray row(double frequency, double times) const {
    Scene scene = table_tray_scene();
    std::get<HarmonicMotion>(*scene.tray.motion).frequency = frequency;
    const TableTray tray = table_tray(scene);
    return {tray, times * rate(tray), 0.01};
  }
  double rate(const TableTray& tray) const {
    return 2 * 40e-6 * table.at(tray.at)->outflow / std::sqrt(4e-3 / standard_gravity);
  }

  const HoleTable table{made_up_records()};
  const ModelError model{0.25, 5, 1};
};

TEST_F(Weighed, SettingGivesWhatIsNeeded) {
  const WeighedTray weighed = row(4.5, 1.2);
  const WeighedPlan plan = plan_weighed(weighed.mass_rate * 0.99, weighed.tray, {weighed}, table, model);
  EXPECT_NEAR(plan.rows[0].predicted * 1.2, weighed.mass_rate, 1e-12);
  EXPECT_GT(plan.factor, 1.1);
  EXPECT_LT(plan.factor, 1.2) << "far from it not all of it: a part is taken for this setting's own";
  ASSERT_FALSE(plan.settings.empty());
  for (const CorrectedSetting& setting : plan.settings) {
    EXPECT_LT(setting.low, plan.needed);
    EXPECT_GT(setting.high, plan.needed);
    EXPECT_NEAR(rate(row(setting.frequency, 1).tray) / setting.predicted, 1, 1e-6);
  }
  EXPECT_LT(std::log(plan.after.high / plan.after.low), 0.7 * std::log(plan.before.high / plan.before.low));
}

/// What is said to have been known before is what a plan says of the same tray.
TEST_F(Weighed, IsNarrowedFromWhatThePlanSays) {
  const WeighedTray weighed = row(4.5, 1.2);
  const WeighedPlan plan = plan_weighed(weighed.mass_rate, weighed.tray, {weighed}, table, model);
  const FactorRange planned = expected_range(table_error(table, weighed.tray.at, weighed.tray.seed.diameter, model));
  EXPECT_NEAR(plan.before.low, planned.low, 1e-9);
  EXPECT_NEAR(plan.before.high, planned.high, 1e-9);
}

TEST_F(Weighed, WhatWasWeighedIsGivenThereAndKnownBest) {
  const WeighedTray weighed = row(4.5, 1.2);
  const WeighedPlan plan = plan_weighed(weighed.mass_rate, weighed.tray, {weighed}, table, model);
  ASSERT_FALSE(plan.settings.empty());
  EXPECT_NEAR(plan.settings[0].frequency, 4.5, 0.05);
  EXPECT_LT(std::log(plan.settings[0].high / plan.settings[0].low), 0.5 * std::log(plan.after.high / plan.after.low));
}

TEST_F(Weighed, RowsAlikeAreOneSetting) {
  const WeighedTray weighed = row(4.5, 1.2);
  const WeighedPlan once = plan_weighed(weighed.mass_rate, weighed.tray, {weighed}, table, model);
  const WeighedPlan twice = plan_weighed(weighed.mass_rate, weighed.tray, {weighed, weighed}, table, model);
  const WeighedPlan elsewhere = plan_weighed(weighed.mass_rate, weighed.tray, {weighed, row(6, 1.2)}, table, model);
  const auto width = [](const WeighedPlan& plan) { return std::log(plan.after.high / plan.after.low); };
  EXPECT_NEAR(width(twice) / width(once), 1, 0.02);
  EXPECT_LT(width(elsewhere), width(twice));
}

TEST_F(Weighed, ARowThatContradictsTheModelIsTold) {
  EXPECT_GT(plan_weighed(1e-3, row(4.5, 1).tray, {row(4.5, 1.2)}, table, model).rows[0].surprise, surprising);
  EXPECT_LT(plan_weighed(1e-3, row(4.5, 1).tray, {row(4.5, 12)}, table, model).rows[0].surprise, surprising);
}

TEST_F(Weighed, NoFrequencyGivesWhatIsOutOfReach) {
  const WeighedPlan plan = plan_weighed(1, row(4.5, 1).tray, {row(4.5, 1)}, table, model);
  EXPECT_TRUE(plan.settings.empty());
  EXPECT_LT(plan.reach.most, 1);
  EXPECT_LT(plan.reach.least, plan.reach.most);
}

TEST_F(Weighed, RowsOfAnotherTrayAreRefused) {
  const std::pair<const char*, std::function<void(TableTray&)>> cases[] = {
      {"tray.holes: ", [](TableTray& tray) { tray.at.width = 5; }},
      {"tray.holes: ", [](TableTray& tray) { tray.holes = 3; }},
      {"seeds: ", [](TableTray& tray) { tray.seed.diameter = 5e-3; }},
      {"tray.motion.amplitude: ", [](TableTray& tray) { tray.amplitude = 9e-3; }},
  };
  for (const auto& [message, change] : cases) {
    WeighedTray other = row(6, 1);
    change(other.tray);
    const std::vector<WeighedTray> rows{row(4.5, 1), other};
    EXPECT_THAT([&] { plan_weighed(1e-3, rows[0].tray, rows, table, model); },
                ThrowsMessage<InputError>(HasSubstr(message)));
  }
}

/// The answer is for the layout's own bed, whichever was weighed first.
TEST_F(Weighed, RowsMayStandInAnyOrder) {
  const WeighedTray shallow = row(4.5, 1.2);
  WeighedTray deep = row(6, 1.1);
  deep.tray.at.depth -= 2;
  const WeighedPlan one = plan_weighed(shallow.mass_rate, shallow.tray, {shallow, deep}, table, model);
  const WeighedPlan other = plan_weighed(shallow.mass_rate, shallow.tray, {deep, shallow}, table, model);
  ASSERT_FALSE(one.settings.empty());
  ASSERT_EQ(one.settings.size(), other.settings.size());
  for (std::size_t k = 0; k < one.settings.size(); ++k) {
    EXPECT_NEAR(one.settings[k].frequency, other.settings[k].frequency, 1e-6);
    EXPECT_NEAR(one.settings[k].high, other.settings[k].high, 1e-9 * one.settings[k].high);
  }
  EXPECT_NEAR(one.factor, other.factor, 1e-9);
}

TEST_F(Weighed, OutsideTheTable) {
  EXPECT_THAT(
      [&] {
        WeighedTray far = row(4.5, 1);
        far.tray.at.peak_speed = 9;
        plan_weighed(1e-3, row(4.5, 1).tray, {far}, table, model);
      },
      ThrowsMessage<InputError>(HasSubstr("tray.motion.frequency: 9 sqrt(g d) is outside the table")));
}

}  // namespace
}  // namespace vibrosow
