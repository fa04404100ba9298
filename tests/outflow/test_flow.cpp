#include "outflow/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outflow/made_up_run.hpp"

namespace vibrosow {
namespace {

TEST(Pauses, AreTheLongGapsEndsIncluded) {
  const auto found = pauses({1.0, 1.1, 2.0, 2.4, 2.5}, 0, 4, 0.5);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_DOUBLE_EQ(found[0].to, 1.0);
  EXPECT_DOUBLE_EQ(found[1].from, 1.1);
  EXPECT_DOUBLE_EQ(found[1].length(), 0.9);
  EXPECT_DOUBLE_EQ(found[2].length(), 1.5);
  EXPECT_TRUE(pauses({1, 2, 3}, 0, 4, 1).empty()) << "as long as the threshold is not longer";
  EXPECT_EQ(pauses({}, 0, 4, 1).size(), 1u);
}

TEST(Pauses, ThresholdGoesWithTheFallOfAGrain) {
  Scene scene = made_up_scene(1);
  EXPECT_NEAR(pause_threshold(scene), 5 * std::sqrt(4e-3 / 9.81), 1e-15);
  scene.lots = {{.name = "a", .diameter = 4e-3, .number_fraction = 0.75},
                {.name = "b", .diameter = 8e-3, .number_fraction = 0.25}};
  EXPECT_NEAR(pause_threshold(scene), 5 * std::sqrt(5e-3 / 9.81), 1e-15);
}

void add(vibrosow::Run& run, double time, int hole, double x, double mass = 40e-6) {
  add_grain(run, time, hole, 0, mass);
  run.events.back().x = x;
}

/// A grain every 50 ms over 10 s, but for none from 4.5 s to 6.25 s.
vibrosow::Run flow_with_a_pause(const Scene& scene) {
  vibrosow::Run run = made_up_run(scene);
  for (int k = 1; k < 200; ++k)
    if (k <= 90 || k >= 125) add(run, 0.05 * k, 1, k % 4 == 0 ? 0.101 : 0.099);
  return run;
}

TEST(Flow, WindowsSumToTheWhole) {
  const Scene scene = made_up_scene(1);
  const auto rows = flow_over_time(scene, flow_with_a_pause(scene));
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(flow_windows + 1));
  const FlowWindow& whole = rows.back();
  EXPECT_EQ(whole.grains, 165);
  EXPECT_EQ(whole.pauses, 1);
  EXPECT_NEAR(whole.longest_pause, 1.75, 1e-12);
  EXPECT_NEAR(whole.paused, 1.75, 1e-12);
  EXPECT_NEAR(whole.paused_fraction(), 0.175, 1e-12);
  FlowWindow sum;
  for (int k = 0; k < flow_windows; ++k) {
    const FlowWindow& row = rows[static_cast<std::size_t>(k)];
    sum.grains += row.grains, sum.mass += row.mass, sum.pauses += row.pauses, sum.paused += row.paused;
  }
  EXPECT_EQ(sum.grains, whole.grains);
  EXPECT_NEAR(sum.mass, whole.mass, 1e-15);
  EXPECT_EQ(sum.pauses, 1);
  EXPECT_NEAR(sum.paused, whole.paused, 1e-12);
  EXPECT_EQ(rows[4].pauses, 1) << "it begins there";
  EXPECT_NEAR(rows[4].paused, 0.5, 1e-12);
  EXPECT_EQ(rows[5].pauses, 0);
  EXPECT_NEAR(rows[5].paused_fraction(), 1, 1e-12);
  EXPECT_FALSE(rows[5].asymmetry);
}

TEST(Flow, AsymmetryIsOfTheMassLeftAndRightOfItsHole) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run run = made_up_run(scene);
  add(run, 1, 1, 0.095);
  add(run, 2, 1, 0.105, 10e-6);
  add(run, 3, 2, 0.205);
  add(run, 4, 0, 0.9, 1);  // spilled
  const auto rows = flow_over_time(scene, run);
  ASSERT_EQ(rows.size(), 33u) << "two holes and all";
  EXPECT_NEAR(rows[10].asymmetry.value(), 0.6, 1e-12);
  EXPECT_NEAR(rows[21].asymmetry.value(), -1, 1e-12);
  EXPECT_EQ(rows[32].hole, 0);
  EXPECT_EQ(rows[32].grains, 3);
  EXPECT_NEAR(rows[32].asymmetry.value(), (40.0 - 50) / 90, 1e-12);
}

TEST(Flow, EndsWithTheLastGrainOfATrayRunDry) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  for (int k = 1; k <= 40; ++k) add(run, 0.1 * k, 1, 0.1);
  run.tray_empty_since = 3.9;
  const auto rows = flow_over_time(scene, run);
  EXPECT_DOUBLE_EQ(rows.back().to, 4.0);
  EXPECT_EQ(rows.back().pauses, 0);
  EXPECT_EQ(rows.back().grains, 40);
  EXPECT_EQ(rows[9].grains, 5) << "the last one at the very end, and the one at 3.6 s";
}

}  // namespace
}  // namespace vibrosow
