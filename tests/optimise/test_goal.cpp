#include "optimise/goal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Goal, EachIsAMetricOfARun) {
  for (const Goal& goal : goals()) EXPECT_EQ(metric_named(goal.metric).name, goal.metric) << goal.name;
}

TEST(Goal, MostIsTurnedRound) {
  Outflow outflow;
  HoleOutflow& all = outflow.holes.emplace_back();
  all.hole = all.lot = "all";
  all.mass_rate = 0.002;
  all.longest_pause = 0.3;
  outflow.spilled_fraction = 0.1;
  EXPECT_DOUBLE_EQ(goal_named("rate").of(outflow).value(), -0.002);
  EXPECT_DOUBLE_EQ(goal_named("pause").of(outflow).value(), 0.3);
  EXPECT_DOUBLE_EQ(goal_named("spilled").of(outflow).value(), 0.1);
  EXPECT_FALSE(goal_named("unevenness").of(outflow));
  EXPECT_EQ(&goal_named("evenness"), &goal_named("unevenness")) << "its old name";
}

TEST(Goal, UnknownNameIsToldWithTheList) {
  EXPECT_THAT([] { goal_named("unevennes"); }, ThrowsMessage<InputError>(HasSubstr("unevenness, instability, pause")));
}

/// Slices as thick and as many for every layout compare as trays do; others are compared as trays.
TEST(Goal, RatesOfUnlikeSlicesAreThoseOfTheTray) {
  const Goal& rate = goal_named("rate");
  Scene shallow;
  shallow.lots = {SeedLot{.name = "pea", .diameter = 7e-3, .mass = 2e-4}};
  shallow.tray.depth = 0.02;
  Scene deep = shallow, small = shallow, none = shallow, solid = shallow;
  deep.tray.depth = 0.08;
  small.lots[0].diameter = 2e-3;
  none.tray.depth.reset();
  solid.space = Space::three_dimensional;
  EXPECT_EQ(&goal_between(rate, {shallow, shallow}), &rate);
  EXPECT_EQ(&goal_between(rate, {none, none}), &rate);
  EXPECT_EQ(&goal_between(rate, {solid, solid}), &rate);
  for (const Scene& other : {deep, small, solid})
    EXPECT_EQ(goal_between(rate, {shallow, other}).metric, "tray_rate_g_per_s");
  EXPECT_EQ(&goal_between(goal_named("pause"), {shallow, deep}), &goal_named("pause"));
  EXPECT_THAT(
      [&] {
        goal_between(rate, {shallow, none});
      },
      ThrowsMessage<InputError>(HasSubstr("tray.depth is missing")));
}

/// A pause may be longer in a longer window, and chance weighs less.
TEST(Goal, WhatDependsOnTheWindowNeedsWindowsAlike) {
  Scene usual, later, longer;
  usual.space = later.space = longer.space = Space::three_dimensional;
  usual.run.duration = later.run.duration = 4, longer.run.duration = 6;
  usual.run.measure_from = longer.run.measure_from = 1, later.run.measure_from = 1.1;
  for (const char* name : {"unevenness", "instability", "pause"}) {
    EXPECT_EQ(&goal_between(goal_named(name), {usual, later}), &goal_named(name));
    EXPECT_THAT(
        [&] {
          goal_between(goal_named(name), {usual, longer});
        },
        ThrowsMessage<InputError>(HasSubstr("layouts measure from 3 to 5 s")));
  }
  for (const char* name : {"rate", "spilled"})
    EXPECT_EQ(&goal_between(goal_named(name), {usual, longer}), &goal_named(name));
}

TEST(Goal, InstabilityNeedsPartsAlike) {
  const auto of_periods = [](int periods) {
    Scene scene;
    scene.space = Space::three_dimensional;
    scene.run.duration = 4, scene.tray.holes.resize(1);
    scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = periods / 4.0};
    return scene;
  };
  const Goal& instability = goal_named("instability");
  EXPECT_EQ(&goal_between(instability, {of_periods(24), of_periods(25)}), &instability) << "12 and 8 parts";
  EXPECT_EQ(&goal_between(instability, {of_periods(200), of_periods(45)}), &instability);
  const auto refuses = [&](int some, int others, const std::string& parts) {
    EXPECT_THAT(
        [&] {
          goal_between(instability, {of_periods(some), of_periods(others)});
        },
        ThrowsMessage<InputError>(HasSubstr("windows have " + parts + " of them")));
  };
  refuses(14, 15, "7 to 14");
  refuses(1, 40, "0 to 10");
  EXPECT_NO_THROW(goal_between(goal_named("pause"), {of_periods(14), of_periods(15)}));
}

TEST(WantedRate, ReadsSeedsAndMass) {
  const WantedRate seeds = read_wanted_rate("43 seeds/s +- 5 %");
  EXPECT_EQ(rate_metric(seeds).name, "tray_seeds_per_s");
  EXPECT_DOUBLE_EQ(seeds.low, 43 * 0.95);
  EXPECT_DOUBLE_EQ(seeds.high, 43 * 1.05);
  const WantedRate mass = read_wanted_rate("12 g/min +- 1 g/min");
  EXPECT_EQ(rate_metric(mass).name, "tray_rate_g_per_s");
  EXPECT_NEAR(mass.low, 0.011 / 60, 1e-12);
  EXPECT_NEAR(mass.high, 0.013 / 60, 1e-12);
  EXPECT_NEAR(read_wanted_rate("60 seeds/min +- 10 %").high, 1.1, 1e-12);
  for (const char* text : {"43 seeds/s ± 5 %", "43 seeds/s ±5%", "43 seeds/s +/- 5 %"})
    EXPECT_EQ(read_wanted_rate(text).high, seeds.high) << text;
}

TEST(WantedRate, RefusesWhatCannotBeMeant) {
  for (const char* text : {"43 seeds/s", "43 +- 5 %", "43 seeds/s +- 5", "43 seeds/s +- 1 g/s", "43 seeds/s +- 100 %",
                           "-4 g/s +- 5 %", "4 mm +- 5 %", "+- 5 %", "", "4 g/s +- 0 %", "1e308 seeds/s +- 90 %"})
    EXPECT_THAT([&] { read_wanted_rate(text); }, ThrowsMessage<InputError>(HasSubstr("43 seeds/s +- 5 %"))) << text;
}

}  // namespace
}  // namespace vibrosow
