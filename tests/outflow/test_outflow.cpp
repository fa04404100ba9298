#include "outflow/outflow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "made_up_run.hpp"

namespace vibrosow {
namespace {

/// Of a hole, so many seeds in each of its eight seconds of measuring.
Outflow outflow_of_seconds(const std::vector<int>& seeds) {
  const Scene scene = made_up_scene(1);
  Run run = made_up_run(scene);
  for (std::size_t second = 0; second < seeds.size(); ++second)
    for (int i = 0; i < seeds[second]; ++i)
      add_grain(run, 2 + static_cast<double>(second) + (i + 0.5) / seeds[second], 1);
  return measure_outflow(scene, run);
}

TEST(ChanceOfRate, OfReplicatesIsStudents) {
  const Outflow a = outflow_of_seconds({10, 10, 10, 10, 10, 10, 10, 10}),
                b = outflow_of_seconds({12, 12, 12, 12, 12, 12, 12, 12});
  // 10 and 12 seeds/s: t(0.975, 1) = 12.706, standard error 1.
  EXPECT_NEAR(*chance_of_rate({&a, &b}), 12.7062 / 11, 1e-5);
}

TEST(ChanceOfRate, OfOneRunIsThatOfItsBlocks) {
  const Outflow even = outflow_of_seconds({10, 10, 10, 10, 10, 10, 10, 10});
  const Outflow uneven = outflow_of_seconds({5, 5, 15, 15, 5, 5, 15, 15});
  const MeanWithInterval blocks = rate_of_blocks(uneven);
  EXPECT_GT(*blocks.half_width_95, 1);
  EXPECT_NEAR(*chance_of_rate({&uneven}), *blocks.half_width_95 / blocks.mean, 1e-12);
  EXPECT_LT(*chance_of_rate({&even}), 0.1);
  EXPECT_NEAR(rate_of_blocks(uneven, 0).mean, blocks.mean, 1e-12) << "its only hole";
}

TEST(ChanceOfRate, IsNoneWhereNothingFlowed) {
  const Outflow none = outflow_of_seconds({});
  EXPECT_FALSE(chance_of_rate({&none}));
  EXPECT_FALSE(chance_of_rate({&none, &none}));
  EXPECT_FALSE(chance_of_rate({}));
  const Scene closed = made_up_scene(0);
  const Outflow without = measure_outflow(closed, made_up_run(closed));
  EXPECT_FALSE(chance_of_rate({&without}));
}

TEST(Rows, CountOnlyTheWindowAndNoSpilledGrain) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run run = made_up_run(scene);
  add_grain(run, 1.999, 1);  // before the window
  add_grain(run, 2, 1);      // its ends belong to it
  add_grain(run, 5, 1);
  add_grain(run, 6, 0);  // spilled
  add_grain(run, 7, 2);
  add_grain(run, 10, 1);
  add_grain(run, 10.001, 2);

  const Outflow outflow = measure_outflow(scene, run);
  ASSERT_EQ(outflow.holes.size(), 3U);
  const HoleOutflow& first = outflow.holes[0];
  EXPECT_EQ(first.hole, "1");
  EXPECT_EQ(first.lot, "wheat");
  EXPECT_DOUBLE_EQ(*first.centre, 0.1);
  EXPECT_DOUBLE_EQ(*first.width, 0.016);
  EXPECT_EQ(first.grains, 3);
  EXPECT_DOUBLE_EQ(first.seeds_per_s, 3.0 / 8);
  EXPECT_DOUBLE_EQ(first.mass_rate, 3 * 40e-6 / 8);
  EXPECT_EQ(outflow.holes[1].grains, 1);
  const HoleOutflow& all = outflow.holes[2];
  EXPECT_EQ(all.hole, "all");
  EXPECT_EQ(all.lot, "all");
  EXPECT_FALSE(all.centre);
  EXPECT_EQ(all.grains, 4);
  EXPECT_DOUBLE_EQ(outflow.spilled_fraction, 1.0 / 7);
  EXPECT_EQ(outflow.note(), "a rate from 4 seeds");
}

TEST(Rows, OfSeveralLotsComePerLotAndTogether) {
  Scene scene = made_up_scene(1);
  scene.lots[0].number_fraction = 0.75;
  scene.lots.push_back({.name = "pea", .diameter = 8e-3, .mass = 250e-6, .number_fraction = 0.25});
  scene.tray.depth = 0.06;
  vibrosow::Run run = made_up_run(scene);
  add_grain(run, 3, 1, 0);
  add_grain(run, 4, 1, 1, 250e-6);

  const Outflow outflow = measure_outflow(scene, run);
  std::vector<std::pair<std::string, std::string>> names;
  for (const HoleOutflow& row : outflow.holes) names.emplace_back(row.hole, row.lot);
  EXPECT_EQ(names, (std::vector<std::pair<std::string, std::string>>{
                       {"1", "wheat"}, {"1", "pea"}, {"1", "all"}, {"all", "wheat"}, {"all", "pea"}, {"all", "all"}}));
  EXPECT_DOUBLE_EQ(find_row(outflow, "1", "pea")->mass, 250e-6);
  EXPECT_DOUBLE_EQ(find_row(outflow, "all", "all")->mass, 290e-6);
  EXPECT_DOUBLE_EQ(*outflow.depth_factor, 0.06 / ((0.75 * 64 + 0.25 * 512) / (0.75 * 16 + 0.25 * 64) * 1e-3));
}

TEST(DepthFactor, IsOfTheSlicesThickness) {
  Scene scene = made_up_scene(1);
  scene.tray.depth = 0.06;
  scene.lots[0].sizes = {SizeDistribution::Kind::table, scene.lots[0].diameter, 0, 0, 0, {4e-3, 8e-3}, {0.5, 0.5}};
  EXPECT_NEAR(*measure_outflow(scene, made_up_run(scene)).depth_factor, 0.06 / 7.2e-3, 1e-12) << "the Sauter mean";
  scene.lots[0].sizes = {};
  scene.lots[0].shape = Shape::clump;
  scene.lots[0].discs = {{-1e-3, 0, 1.5e-3}, {1e-3, 0, 1e-3}};
  EXPECT_DOUBLE_EQ(*measure_outflow(scene, made_up_run(scene)).depth_factor, 0.06 / 3e-3) << "of its largest disc";
}

TEST(Rows, AreFoundByNameOrAll) {
  const Scene scene = made_up_scene(2);
  const Outflow outflow = measure_outflow(scene, made_up_run(scene));
  EXPECT_EQ(find_row(outflow, "2", "all"), &outflow.holes[1]);
  EXPECT_EQ(find_row(outflow, "all", "wheat"), &outflow.holes[2]);
  EXPECT_EQ(find_row(outflow, "3", "all"), nullptr);
  EXPECT_EQ(find_row(outflow, "all", "barley"), nullptr);
  EXPECT_FALSE(outflow.depth_factor);
}

TEST(LongestPause, CountsTheWindowsEnds) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run run = made_up_run(scene);
  add_grain(run, 1, 1);
  for (const double time : {4.0, 5.0, 9.0}) add_grain(run, time, 1);
  add_grain(run, 9.5, 2);
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_DOUBLE_EQ(outflow.holes[0].longest_pause, 4);    // 5 to 9
  EXPECT_DOUBLE_EQ(outflow.holes[1].longest_pause, 7.5);  // 2 to 9.5
  EXPECT_DOUBLE_EQ(find_row(measure_outflow(scene, made_up_run(scene)), "1", "all")->longest_pause, 8);
}

TEST(Window, EndsWithARunThatEndsEarly) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  run.status = RunStatus::stopped_by_guard;
  run.stop_reason = "relative overlap 0.6";
  run.end_time = 6;
  add_grain(run, 3, 1);
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_DOUBLE_EQ(outflow.window.to, 6);
  EXPECT_DOUBLE_EQ(outflow.holes[0].seeds_per_s, 0.25);
  EXPECT_EQ(outflow.note(), "stopped: relative overlap 0.6; a rate from 1 seed");
}

TEST(Window, NeverReachedGivesNoRate) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run run = made_up_run(scene);
  run.status = RunStatus::interrupted;
  run.end_time = 1.5;
  add_grain(run, 1, 1);
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_TRUE(std::isnan(outflow.holes[0].mass_rate));
  EXPECT_TRUE(std::isnan(outflow.holes[0].longest_pause));
  EXPECT_FALSE(unevenness_of({&outflow}));
  EXPECT_FALSE(outflow.instability_cv);
  EXPECT_EQ(outflow.note(), "interrupted; ended before the measuring window");
}

TEST(Window, OfARunThatGoesOnEndsNowWithoutADoubt) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run run = made_up_run(scene);
  run.goes_on = true;
  run.end_time = 1.5;
  add_grain(run, 1, 1);
  EXPECT_EQ(measure_outflow(scene, run).note(), "") << "measuring has not begun";
  run.end_time = 6;
  for (int i = 0; i < 40; ++i) add_grain(run, 2 + 0.1 * i, 1);
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_DOUBLE_EQ(outflow.window.to, 6);
  EXPECT_DOUBLE_EQ(outflow.holes[0].seeds_per_s, 10);
  EXPECT_EQ(outflow.note(), "");
}

/// A run in which `grains` seeds left evenly over the window, of `put_in`.
vibrosow::Run sown(const Scene& scene, int grains, std::int64_t put_in) {
  vibrosow::Run run = made_up_run(scene);
  for (int i = 0; i < grains; ++i) add_grain(run, 2.1 + 7.8 * i / grains, 1);
  run.balance.put_in = put_in;
  run.balance.inside = put_in - grains;
  run.tray_at_begin = put_in, run.tray_at_end = run.balance.inside;
  return run;
}

TEST(Note, SaysWhatIsWrong) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = sown(scene, 40, 1000);
  EXPECT_EQ(measure_outflow(scene, run).note(), "");
  run.outside_the_model = true;
  run.tray_empty_since = 3.25;
  EXPECT_EQ(measure_outflow(scene, run).note(), "outside the model; ran dry at 3.25 s");
  run.outside_the_model = false;
  run.tray_empty_since = scene.run.duration;
  EXPECT_EQ(measure_outflow(scene, run).note(), "");
}

/// Whether it is empty at the run's end is chance.
TEST(Note, ATrayThatPassesItsRainAtOnceHasNotRunDry) {
  Scene scene = made_up_scene(1);
  scene.tray.rain.emplace();
  vibrosow::Run run = sown(scene, 40, 40);
  run.tray_empty_since = 9.9, run.tray_at_begin = 1, run.tray_at_end = 0;
  EXPECT_EQ(measure_outflow(scene, run).note(), "");
  scene.tray.rain->stop = 9.5;
  EXPECT_EQ(measure_outflow(scene, run).note(), "ran dry at 9.9 s");
}

TEST(Note, ATrayThatDrainsIsNotAFullOne) {
  Scene scene = made_up_scene(1);
  const std::string drained = "drained in the window: 428 of the 500 seeds in the tray gone";
  EXPECT_EQ(measure_outflow(scene, sown(scene, 428, 500)).note(), drained);
  EXPECT_EQ(measure_outflow(scene, sown(scene, 240, 500)).note(), "");
  vibrosow::Run run = sown(scene, 428, 500);
  run.tray_at_begin = -1;
  EXPECT_EQ(measure_outflow(scene, run).note(), "") << "it ended before the window";
  run.tray_at_begin = 8, run.tray_at_end = 3;
  EXPECT_EQ(measure_outflow(scene, run).note(), "") << "which a tray that is fed may hold now and then";
}

TEST(Note, AHopperKeptFullSaysNothingOfTheTray) {
  Scene scene = made_up_scene(1);
  scene.hopper.emplace();
  scene.hopper->fill = Fill{.count = 200, .keep = true};
  vibrosow::Run run = sown(scene, 428, 2600);
  run.tray_at_begin = 302, run.tray_at_end = 9;  // the hopper's outlet has arched
  EXPECT_EQ(measure_outflow(scene, run).note(), "drained in the window: 293 of the 302 seeds in the tray gone");
  run.tray_at_end = 290;
  EXPECT_EQ(measure_outflow(scene, run).note(), "");
}

/// A run of the eight seconds' window with so many seeds in each.
vibrosow::Run run_of_seconds(const Scene& scene, const std::vector<int>& seeds) {
  vibrosow::Run run = made_up_run(scene);
  for (std::size_t second = 0; second < seeds.size(); ++second)
    for (int i = 0; i < seeds[second]; ++i)
      add_grain(run, 2 + static_cast<double>(second) + (i + 0.5) / seeds[second], 1);
  return run;
}

TEST(FlowChanged, IsSaidOfAFlowThatDiesOrBeginsInTheWindow) {
  const Scene scene = made_up_scene(1);
  const std::vector<int> dies = {294, 251, 308, 325, 278, 212, 33, 10};
  std::vector<int> begins(dies.rbegin(), dies.rend());
  EXPECT_EQ(measure_outflow(scene, run_of_seconds(scene, dies)).note(),
            "the flow changed in the window: from 281 to 69 seeds/s, first and last 2.67 s");
  EXPECT_EQ(measure_outflow(scene, run_of_seconds(scene, begins)).doubts.front().kind, DoubtKind::flow_changed);
  vibrosow::Run dry = run_of_seconds(scene, dies);
  dry.tray_empty_since = 9;
  EXPECT_EQ(measure_outflow(scene, dry).note(), "ran dry at 9 s") << "which says why";
}

TEST(FlowChanged, IsNotSaidOfChanceOrOfLessThanHalf) {
  const Scene scene = made_up_scene(1);
  EXPECT_EQ(measure_outflow(scene, run_of_seconds(scene, {14, 14, 14, 9, 9, 4, 4, 4})).note(), "");
  EXPECT_EQ(measure_outflow(scene, run_of_seconds(scene, {300, 300, 300, 200, 200, 160, 160, 160})).note(), "");
}

/// Of twenty seeds each: four in the first third, ten in the last.
TEST(FlowChanged, IsNotSaidOfBursts) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  for (const double burst : {2.2, 2.9, 3.6, 4.4, 7.4, 7.6, 7.9, 8.1, 8.3, 8.6, 8.9, 9.2, 9.5, 9.8})
    for (int i = 0; i < 20; ++i) add_grain(run, burst + 1e-3 * i, 1);
  EXPECT_EQ(measure_outflow(scene, run).note(), "");
}

TEST(FlowChanged, IsNotSaidOfADrivesOwnRhythm) {
  Scene scene = made_up_scene(1);
  vibrosow::Run run = run_of_seconds(scene, {90, 90, 90, 90, 10, 10, 10, 10});
  const auto says = [&](double period) {
    scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 1 / period};
    const std::vector<Doubt> doubts = measure_outflow(scene, run).doubts;
    return std::ranges::any_of(doubts, [](const Doubt& one) { return one.kind == DoubtKind::flow_changed; });
  };
  EXPECT_FALSE(says(10)) << "a part of a period";
  EXPECT_FALSE(says(8));
  EXPECT_FALSE(says(4)) << "two periods, which may take turns";
  EXPECT_TRUE(says(2));
  run.status = RunStatus::interrupted;
  run.end_time = 9.8;
  EXPECT_FALSE(says(2)) << "without the end of the fourth, two pairs of periods would share seeds";
  run = run_of_seconds(scene, {90, 90, 10, 10, 90, 90, 10, 10});
  EXPECT_FALSE(says(2)) << "of four periods two and two are compared, not the first with the last";
}

TEST(Note, SaysClogsLossesFewSeedsAndAFeederThatFellBehind) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = sown(scene, 12, 1315);
  run.end_reason = "no grain left for 1 s; 1303 are still inside";
  run.end_time = 4.36;
  EXPECT_EQ(measure_outflow(scene, run).note(),
            "ended at 4.36 s: no grain left for 1 s; 1303 are still inside; a rate from 12 seeds");
  run = sown(scene, 40, 1000);
  run.balance.inside -= 500, run.tray_at_end -= 500;
  run.balance.lost = 500;
  run.warnings = {
      {DoubtKind::feeder_behind, "hopper.fill.keep falls behind: 60 of 200 seeds missing at 1 s, for want of room"},
      {DoubtKind::guard_warned, "soft"}};
  const Outflow outflow = measure_outflow(scene, run);
  std::vector<DoubtKind> kinds;
  for (const Doubt& doubt : outflow.doubts) kinds.push_back(doubt.kind);
  EXPECT_EQ(kinds, (std::vector{DoubtKind::drained, DoubtKind::seeds_lost, DoubtKind::feeder_behind,
                                DoubtKind::guard_warned}));
  EXPECT_NE(outflow.note().find("500 of 1000 seeds lost through walls"), std::string::npos);
  EXPECT_NE(outflow.note().find("60 of 200 seeds missing"), std::string::npos);
}

TEST(Unevenness, OfARunIsOfFiveBlocksOfItsWindow) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run run = made_up_run(scene);
  for (int i = 0; i < 500; ++i) add_grain(run, 1, 2);  // before the window
  std::vector<std::vector<std::int64_t>> blocks;
  for (int k = 0; k < 5; ++k) {
    blocks.push_back({20 + k % 2, 60});
    for (int hole = 0; hole < 2; ++hole)
      for (int i = 0; i < blocks.back()[static_cast<std::size_t>(hole)]; ++i) add_grain(run, 2.1 + 1.6 * k, hole + 1);
  }
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_EQ(outflow.grains_of_hole_in_block, blocks);
  EXPECT_NEAR(*outflow.raw_cv, std::sqrt(2.0) * 99 / 201, 1e-12);
  const auto expected = unevenness(blocks);
  const auto unevenness = unevenness_of({&outflow});
  EXPECT_EQ(*unevenness->cv, *expected->cv);
  EXPECT_EQ(unevenness->high, expected->high);
}

TEST(CountsInBlocks, TakeTheLaterBlockAtAnEnd) {
  const std::vector<double> ends = {1, 2, 3};
  EXPECT_EQ(counts_in_blocks({0.9, 1, 1.5, 2, 3, 3.1}, ends), (std::vector<std::int64_t>{2, 2}));
  EXPECT_TRUE(counts_in_blocks({1}, {}).empty());
}

TEST(Window, OfAShakenTrayIsWholePeriods) {
  Scene scene = made_up_scene(1);  // measured from 2 to 10 s
  scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 0.3};
  vibrosow::Run run = made_up_run(scene);
  for (int i = 0; i < 100; ++i) add_grain(run, 2.05 + 0.079 * i, 1);
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_DOUBLE_EQ(outflow.window.from, 10 - 2 / 0.3);
  EXPECT_NEAR(outflow.holes[0].seeds_per_s, 1 / 0.079, 0.3);
  EXPECT_EQ(outflow.note(), "");
  std::get<HarmonicMotion>(*scene.tray.motion).frequency = 0.1;
  EXPECT_EQ(measure_outflow(scene, run).note(), "measured over 8 s, a part of one period of the drive, 10 s");
}

TEST(Instability, IsTheCvOverTenEqualWindows) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run steady = made_up_run(scene);
  vibrosow::Run halting = made_up_run(scene);
  for (int i = 0; i < 10; ++i) {
    add_grain(steady, 2.4 + 0.8 * i, 1);
    if (i % 2 == 0)
      for (int k = 0; k < 2; ++k) add_grain(halting, 2.4 + 0.8 * i, 1);
  }
  EXPECT_NEAR(*measure_outflow(scene, steady).instability_cv, 0, 1e-12);
  // five windows with 2 and five with 0: s^2 = 10 / 9
  EXPECT_NEAR(*measure_outflow(scene, halting).instability_cv, std::sqrt(10.0 / 9), 1e-12);
}

/// All seeds of a period come in its first half.
TEST(Instability, IsNotTheRhythmOfTheDrive) {
  Scene scene = made_up_scene(1);
  for (const int periods : {4, 5, 7, 10, 13, 20}) {
    const double period = 8.0 / periods;
    scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 1 / period};
    vibrosow::Run run = made_up_run(scene);
    for (int k = 0; k < periods; ++k)
      for (int i = 0; i < 20; ++i) add_grain(run, 2 + period * (k + 0.025 * (i + 0.5)), 1);
    EXPECT_NEAR(measure_outflow(scene, run).instability_cv.value(), 0, 1e-12) << periods;
  }
  scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 1 / 8.0};
  EXPECT_FALSE(measure_outflow(scene, run_of_seconds(scene, {9, 9, 9, 9, 9, 9, 9, 9})).instability_cv) << "one period";
}

TEST(Instability, OfCountingIsOfWhatThePartsHold) {
  const MeasuringWindow window{.from = 2, .to = 10};
  std::vector<double> times;
  for (int i = 0; i < 40; ++i) times.push_back(2.1 + 0.2 * i);
  EXPECT_DOUBLE_EQ(instability(times, window)->counting_cv, 0.5);
}

TEST(Instability, NeedsTwoGrains) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  add_grain(run, 10, 1);
  EXPECT_FALSE(measure_outflow(scene, run).instability_cv);
  add_grain(run, 10, 1);
  EXPECT_TRUE(measure_outflow(scene, run).instability_cv);
}

TEST(Notes, WhatEndedEmptyRanDryAndDidNotClog) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  run.end_reason = "no grain left for 1 s";
  EXPECT_EQ(measure_outflow(scene, run).doubts.front().kind, DoubtKind::stopped_flowing);
  run.balance.inside = 0;
  run.tray_empty_since = 5;
  const std::vector<Doubt> doubts = measure_outflow(scene, run).doubts;
  EXPECT_EQ(doubts.front().kind, DoubtKind::ran_dry);
  EXPECT_TRUE(std::ranges::none_of(doubts, [](const Doubt& one) { return one.kind == DoubtKind::stopped_flowing; }));
}

TEST(Notes, SeedsThatFallBesideAreSaidToBeSpilled) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  for (int i = 0; i < 95; ++i) add_grain(run, 2.05 + 0.08 * i, 1);
  for (int i = 0; i < 5; ++i) add_grain(run, 4, 0);
  EXPECT_EQ(measure_outflow(scene, run).note(), "");
  add_grain(run, 4, 0);
  EXPECT_EQ(measure_outflow(scene, run).note(), "6 of the 101 seeds that left fell past the tray's rim");
}

}  // namespace
}  // namespace vibrosow
