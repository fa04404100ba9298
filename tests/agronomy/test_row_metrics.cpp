#include "agronomy/row_metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "outflow/made_up_run.hpp"

namespace vibrosow {
namespace {

/// A tray in 3D with so many holes, measured from 2 s to 10 s.
Scene tray_3d(int holes) {
  Scene scene = made_up_scene(holes);
  scene.space = Space::three_dimensional;
  scene.tray.depth = 0.06;
  return scene;
}

Drill a_hole_a_row(int holes) {
  Drill drill{.pace = {.row_spacing = 0.25, .speed = 2}, .hole_to_row = {}};
  for (int hole = 1; hole <= holes; ++hole) drill.hole_to_row.push_back(hole);
  return drill;
}

/// Hole by hole so many seeds of 40 mg, evenly over the window, the last at its end.
Run evenly(const Scene& scene, const std::vector<int>& seeds) {
  Run run = made_up_run(scene);
  for (std::size_t hole = 0; hole < seeds.size(); ++hole)
    for (int i = 1; i <= seeds[hole]; ++i) add_grain(run, 2 + 8.0 * i / seeds[hole], static_cast<int>(hole) + 1);
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);
  return run;
}

DrillMetrics metrics_of(const Scene& scene, const Run& run, const Drill& drill) {
  return drill_metrics(scene, run, measure_outflow(scene, run), drill);
}

TEST(RowMetrics, RatesOfARowAndOfTheGround) {
  const Scene scene = tray_3d(2);
  const DrillMetrics metrics = metrics_of(scene, evenly(scene, {80, 160}), a_hole_a_row(2));
  ASSERT_EQ(metrics.rows.size(), 3u);
  // 80 seeds of 40 mg in 8 s: 10 seeds/s, 0.4 g/s; over 0.25 m and 2 m/s 20 seeds and 0.8 g to the square metre.
  EXPECT_DOUBLE_EQ(*metrics.rows[0].seeds_per_s, 10);
  EXPECT_NEAR(*metrics.rows[0].mass_rate, 0.4e-3, 1e-15);
  EXPECT_DOUBLE_EQ(*metrics.rows[0].seeds_per_m2, 20);
  EXPECT_NEAR(*metrics.rows[0].kg_per_m2 / kilogram_per_hectare, 8, 1e-9);
  EXPECT_NEAR(*metrics.rows[0].longest_pause, 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(*metrics.rows[1].seeds_per_s, 20);
  // Of ten parts of the window, 8 and 16 seeds each by chance.
  EXPECT_DOUBLE_EQ(*metrics.rows[0].instability_counting_cv, 1 / std::sqrt(8));
  EXPECT_DOUBLE_EQ(*metrics.rows[1].instability_counting_cv, 1 / std::sqrt(16));
  // All: rates together, over both rows' ground.
  EXPECT_EQ(metrics.all().row, 0);
  EXPECT_DOUBLE_EQ(*metrics.all().seeds_per_s, 30);
  EXPECT_DOUBLE_EQ(*metrics.all().seeds_per_m2, 30);
  EXPECT_EQ(metrics.all().holes, (std::vector<int>{1, 2}));
  EXPECT_NEAR(*metrics.all().longest_pause, 0.1, 1e-12);
  // Between 80 and 160: sqrt(2) 40 over 120.
  EXPECT_NEAR(*metrics.all().between->raw_cv, std::sqrt(2.0) / 3, 1e-12);
  EXPECT_NEAR(*metrics.all().between->mass_cv, std::sqrt(2.0) / 3, 1e-12);
  // In each of five blocks 16 and 32, but for a seed that falls on the edge of one.
  EXPECT_NEAR(*unevenness_of({&*metrics.all().between})->cv, std::sqrt(2.0) / 3, 0.02);
}

TEST(RowMetrics, OfAMixturesSliceAreOfSlicesByVolume) {
  Scene scene = tray_3d(1);
  scene.space = Space::two_dimensional;
  scene.lots[0].diameter = 1e-3, scene.lots[0].number_fraction = 216.0 / 217;
  scene.lots.push_back({.name = "pea", .diameter = 6e-3, .mass = 8.64e-3, .number_fraction = 1.0 / 217});
  const DrillMetrics metrics = metrics_of(scene, evenly(scene, {80}), a_hole_a_row(1));
  EXPECT_NEAR(*metrics.rows[0].seeds_per_s, 10 * 0.06 / (12e-3 / 7), 1e-9) << "by number it were 586";
}

TEST(RowMetrics, SpacingsAreSpeedTimesTime) {
  const Scene scene = tray_3d(2);
  vibrosow::Run run = made_up_run(scene);
  for (const double time : {3.0, 3.1, 3.2, 3.22, 3.4}) add_grain(run, time, 1);  // 200, 200, 40, 360 mm; mean 200
  for (const double time : {5.0, 6.0}) add_grain(run, time, 2);
  add_grain(run, 1.9, 2);  // before the window
  add_grain(run, 5.5, 0);  // spilled
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);
  const DrillMetrics metrics = metrics_of(scene, run, a_hole_a_row(2));
  const SpacingMetrics& row = *metrics.rows[0].spacing;
  EXPECT_EQ(row.spacings, 4);
  EXPECT_NEAR(row.reference, 0.2, 1e-9);
  EXPECT_DOUBLE_EQ(row.multiples, 0.25);
  EXPECT_DOUBLE_EQ(row.skips, 0.25);
  EXPECT_EQ(metrics.rows[1].spacing->spacings, 1);
  EXPECT_NEAR(metrics.rows[1].spacing->mean, 2, 1e-9);
  EXPECT_EQ(metrics.all().spacing->spacings, 5);  // each beside its own row's mean
  EXPECT_DOUBLE_EQ(metrics.all().spacing->skips, 0.2);
  EXPECT_NEAR(*metrics.rows[0].poisson_multiples, 1 - std::exp(-0.5), 1e-12);
  EXPECT_NEAR(*metrics.rows[0].poisson_skips, std::exp(-1.5), 1e-12);
}

TEST(RowMetrics, RowsMayShareAHoleInEqualParts) {
  const Scene scene = tray_3d(2);
  Drill drill = a_hole_a_row(2);
  drill.rows_per_hole = 4;
  drill.hole_to_row = {1, 5};
  const DrillMetrics metrics = metrics_of(scene, evenly(scene, {80, 160}), drill);
  ASSERT_EQ(metrics.rows.size(), 9u);
  EXPECT_EQ(metrics.rows[3].row, 4);
  EXPECT_EQ(metrics.rows[3].holes, std::vector<int>{1});
  EXPECT_EQ(metrics.rows[4].holes, std::vector<int>{2});
  EXPECT_DOUBLE_EQ(*metrics.rows[3].seeds_per_s, 2.5);
  EXPECT_DOUBLE_EQ(*metrics.rows[4].seeds_per_s, 5);
  EXPECT_DOUBLE_EQ(*metrics.all().seeds_per_s, 30);
  EXPECT_DOUBLE_EQ(*metrics.all().seeds_per_m2, 30 / (8 * 0.25 * 2));
  EXPECT_NEAR(*metrics.all().between->raw_cv, std::sqrt(2.0) / 3, 1e-12);
  EXPECT_FALSE(metrics.rows[0].spacing);
  EXPECT_EQ(metrics.rows[0].without_spacing, NoSpacings::shared_hole);
}

TEST(RowMetrics, SeveralHolesMayFeedARow) {
  const Scene scene = tray_3d(3);
  Drill drill = a_hole_a_row(3);
  drill.hole_to_row = {2, 1, 2};
  const DrillMetrics metrics = metrics_of(scene, evenly(scene, {80, 160, 80}), drill);
  ASSERT_EQ(metrics.rows.size(), 3u);
  EXPECT_EQ(metrics.rows[0].holes, std::vector<int>{2});
  EXPECT_EQ(metrics.rows[1].holes, (std::vector<int>{1, 3}));
  EXPECT_DOUBLE_EQ(*metrics.rows[0].seeds_per_s, 20);
  EXPECT_DOUBLE_EQ(*metrics.rows[1].seeds_per_s, 20);
  EXPECT_EQ(*metrics.all().between->raw_cv, 0);
  // Two seeds at a time: every other spacing is nothing.
  EXPECT_NEAR(metrics.rows[1].spacing->multiples, 80.0 / 159, 1e-12);
}

TEST(RowMetrics, OfASliceAreTheTraysAndHaveNoSpacings) {
  Scene scene = made_up_scene(2);
  const vibrosow::Run run = evenly(scene, {80, 160});
  const DrillMetrics bare = metrics_of(scene, run, a_hole_a_row(2));
  EXPECT_FALSE(bare.rows[0].mass_rate);
  EXPECT_FALSE(bare.rows[0].seeds_per_m2);
  EXPECT_TRUE(unevenness_of({&*bare.all().between}));
  scene.tray.depth = 0.06;  // 15 slices of 4 mm
  const DrillMetrics tray = metrics_of(scene, run, a_hole_a_row(2));
  EXPECT_DOUBLE_EQ(*tray.rows[0].seeds_per_s, 150);
  EXPECT_FALSE(tray.rows[0].spacing);
  EXPECT_EQ(tray.rows[0].without_spacing, NoSpacings::plane_slice);
}

TEST(RowMetrics, NothingIsKnownOfARunThatEndedBeforeTheWindow) {
  const Scene scene = tray_3d(2);
  vibrosow::Run run = made_up_run(scene);
  run.status = RunStatus::interrupted;
  run.end_time = 1;
  const DrillMetrics metrics = metrics_of(scene, run, a_hole_a_row(2));
  for (const RowMetric& metric : row_metrics())
    for (const RowMetrics& row : metrics.rows) EXPECT_FALSE(metric.of({row})) << metric.name;
}

TEST(RowMetrics, RefuseADrillOfAnotherTray) {
  const Scene scene = tray_3d(2);
  EXPECT_THROW(metrics_of(scene, made_up_run(scene), a_hole_a_row(3)), std::invalid_argument);
}

/// Twice 80 seeds: the half width is t(0.975, 1) / sqrt(2 x 12) of a seed.
TEST(RowMeans, OfEqualCountsAreNoSurerThanTheirCounts) {
  const Scene scene = tray_3d(1);
  const DrillMetrics one = metrics_of(scene, evenly(scene, {80}), a_hole_a_row(1));
  const RowMeans row = row_means({&one, &one}).front();
  for (const char* rate : {"rate_g_per_min", "seeds_per_s", "kg_per_ha", "seeds_per_m2"})
    EXPECT_NEAR(*row[rate]->half_width_95 / row[rate]->mean, 12.7062 / std::sqrt(24.0) / 80, 1e-5) << rate;
  EXPECT_EQ(*row["longest_pause_s"]->half_width_95, 0);
}

TEST(RowMeans, AreOverTheReplicatesAndBetweenRowsOfAllTogether) {
  const Scene scene = tray_3d(2);
  const DrillMetrics a = metrics_of(scene, evenly(scene, {80, 160}), a_hole_a_row(2));
  const DrillMetrics b = metrics_of(scene, evenly(scene, {160, 80}), a_hole_a_row(2));
  const std::vector<RowMeans> rows = row_means({&a, &b});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].row, 1);
  EXPECT_DOUBLE_EQ(rows[0]["seeds_per_s"]->mean, 15);
  EXPECT_TRUE(rows[0]["seeds_per_s"]->half_width_95);
  EXPECT_DOUBLE_EQ(rows[2]["seeds_per_s"]->mean, 30);
  EXPECT_DOUBLE_EQ(rows[2]["raw_cv_percent"]->mean, 0);  // 240 and 240
  EXPECT_FALSE(rows[2]["raw_cv_percent"]->half_width_95);
  EXPECT_DOUBLE_EQ(rows[2]["mass_cv_percent"]->mean, 0);
  EXPECT_FALSE(rows[0]["raw_cv_percent"]);
  EXPECT_TRUE(row_means({}).empty());
  EXPECT_THROW(rows[0]["kg"], std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
