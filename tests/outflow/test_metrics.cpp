#include "outflow/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "made_up_run.hpp"

namespace vibrosow {
namespace {

TEST(Metrics, HaveEachANameAUnitAndAMeaning) {
  for (const Metric& metric : metrics()) {
    EXPECT_EQ(&metric_named(metric.name), &metric);
    EXPECT_GT(metric.unit_size, 0) << metric.name;
    EXPECT_FALSE(metric.description.empty() || metric.description.ends_with('.')) << metric.name;
    EXPECT_EQ(std::ranges::count(metrics(), metric.name, &Metric::name), 1) << metric.name;
  }
  EXPECT_THROW(metric_named("rate"), std::invalid_argument);
}

TEST(Metrics, AreTakenFromTheRunAndMeansOverItsReplicates) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run one = made_up_run(scene), other = made_up_run(scene);
  for (int i = 0; i < 8; ++i) add_grain(one, 3 + 0.1 * i, 1);     // 1 a second in the window of 8 s
  for (int i = 0; i < 24; ++i) add_grain(other, 3 + 0.1 * i, 1);  // 3 a second
  const Outflow first = measure_outflow(scene, one), second = measure_outflow(scene, other);
  const MetricMeans means({&first, &second});
  EXPECT_DOUBLE_EQ(means["seeds_per_s"]->mean, 2);
  EXPECT_NEAR(*means["seeds_per_s"]->half_width_95, 12.7062 * std::sqrt(2.0) / std::sqrt(2.0), 1e-3);
  EXPECT_DOUBLE_EQ(means["rate_g_per_s"]->mean, 2 * 40e-6);
  EXPECT_FALSE(means["raw_cv_percent"]);     // one hole
  EXPECT_FALSE(means["tray_rate_g_per_s"]);  // no depth
  EXPECT_FALSE(MetricMeans()["seeds_per_s"]);
}

TEST(Metrics, RatesOfEqualCountsAreKnownToOneSeed) {
  const Scene scene = made_up_scene(1);
  vibrosow::Run run = made_up_run(scene);
  for (int i = 0; i < 8; ++i) add_grain(run, 3 + 0.1 * i, 1);  // 1 a second in the window of 8 s
  const Outflow outflow = measure_outflow(scene, run);
  const MetricMeans means({&outflow, &outflow});
  EXPECT_NEAR(*means["seeds_per_s"]->half_width_95, 12.7062 / 8 / std::sqrt(12 * 2.0), 1e-4);
  EXPECT_NEAR(*means["rate_g_per_s"]->half_width_95, 40e-6 * 12.7062 / 8 / std::sqrt(12 * 2.0), 1e-8);
  EXPECT_EQ(*means["longest_pause_s"]->half_width_95, 0);
  EXPECT_NEAR(*chance_of_rate({&outflow, &outflow}), 12.7062 / 8 / std::sqrt(12 * 2.0), 1e-4);
}

TEST(Metrics, OfTheTrayAreTheSlicesTimesItsDepthFactor) {
  Scene scene = made_up_scene(1);
  scene.tray.depth = 0.06;  // of balls of 4 mm: 15
  vibrosow::Run run = made_up_run(scene);
  for (int i = 0; i < 8; ++i) add_grain(run, 3 + 0.1 * i, 1);
  const Outflow outflow = measure_outflow(scene, run);
  EXPECT_DOUBLE_EQ(*metric_named("depth_factor").of({outflow}), 15);
  EXPECT_DOUBLE_EQ(*metric_named("tray_seeds_per_s").of({outflow}), 15);
  const Metric& per_minute = metric_named("tray_rate_g_per_min");
  EXPECT_NEAR(*per_minute.of({outflow}) / per_minute.unit_size, 15 * 0.04 * 60, 1e-9);
}

/// Means over two runs of 300 seeds each, of which so many fall through the first of two holes.
MetricMeans means_of_splits(int first_of_one, int first_of_other) {
  const Scene scene = made_up_scene(2);
  vibrosow::Run one = made_up_run(scene), other = made_up_run(scene);
  for (int i = 0; i < 300; ++i)
    add_grain(one, 3, i < first_of_one ? 1 : 2), add_grain(other, 3, i < first_of_other ? 1 : 2);
  const Outflow first = measure_outflow(scene, one), second = measure_outflow(scene, other);
  return MetricMeans({&first, &second});
}

TEST(Metrics, OfUnevennessAreOfTheSeedsOfAllReplicates) {
  const MetricMeans means = means_of_splits(100, 104);
  EXPECT_NEAR(means["raw_cv_percent"]->mean, std::sqrt(2.0) * 96 / 300, 1e-12);  // 204 and 396
  EXPECT_FALSE(means["raw_cv_percent"]->half_width_95);
  // One run 100 and 200, the other 104 and 196.
  EXPECT_NEAR(means["run_cv_percent"]->mean, std::sqrt(2.0) * (100.0 + 92) / 2 / 300, 1e-12);
  EXPECT_TRUE(means["run_cv_percent"]->half_width_95);
  ASSERT_TRUE(means["unevenness_cv_percent"]);
  EXPECT_FALSE(means["unevenness_cv_percent"]->half_width_95);
  EXPECT_LT(means["unevenness_cv_percent_low"]->mean, means["unevenness_cv_percent"]->mean);
}

TEST(Metrics, UnevennessThatReplicatesDoNotShareHasNoValue) {
  const MetricMeans means = means_of_splits(100, 120);
  EXPECT_NEAR(means["raw_cv_percent"]->mean, std::sqrt(2.0) * 80 / 300, 1e-12);  // 220 and 380
  EXPECT_FALSE(means["unevenness_cv_percent"]);
  EXPECT_EQ(means["unevenness_cv_percent_low"]->mean, 0);
}

}  // namespace
}  // namespace vibrosow
