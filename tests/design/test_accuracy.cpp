#include "design/accuracy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/read_scene.hpp"
#include "plan/step_plan.hpp"
#include "report/accuracy_report.hpp"
#include "study_files.hpp"

namespace vibrosow {
namespace {

AccuracyRow row(Integrator integrator, double steps, double compression, double rate, double grain_steps) {
  AccuracyRow made;
  made.setting = {integrator, steps, compression, 0.02, 1e-5};
  made.mass_rate = MeanWithInterval{rate, 0.03 * rate};
  made.grain_steps = grain_steps;
  made.replicates = 5;
  return made;
}

AccuracyResult made_up() {
  AccuracyResult result;
  result.rows = {
      row(Integrator::velocity_verlet, 40, 1e-4, 1.000, 1000), row(Integrator::velocity_verlet, 20, 1e-4, 1.005, 500),
      row(Integrator::rk2_midpoint, 20, 1e-4, 1.004, 500), row(Integrator::velocity_verlet, 20, 1e-3, 0.95, 100),
      row(Integrator::velocity_verlet, 10, 1e-3, 0.90, 200)};
  compare_with_finest(result);
  return result;
}

TEST(Accuracy, ErrorIsSignedAndItsIntervalHoldsBothRates) {
  const AccuracyResult result = made_up();
  EXPECT_EQ(result.reference, 0u);
  EXPECT_NEAR(*result.rows[3].error_percent, -5.0, 1e-9);
  EXPECT_NEAR(*result.rows[3].error_ci95, 100 * std::hypot(0.03, 0.0285), 1e-9);
  EXPECT_FALSE(result.rows[0].error_ci95);
}

TEST(Accuracy, MidpointCostsTwoEvaluationsAStep) {
  const AccuracyResult result = made_up();
  EXPECT_DOUBLE_EQ(*result.rows[1].cost_ratio, 0.5);
  EXPECT_DOUBLE_EQ(*result.rows[2].cost_ratio, 1.0);
}

TEST(Accuracy, FrontHoldsWhatNothingBeats) {
  const AccuracyResult result = made_up();
  EXPECT_TRUE(result.rows[0].on_front);
  EXPECT_TRUE(result.rows[1].on_front);
  EXPECT_FALSE(result.rows[2].on_front);  // the reference costs as much and errs less
  EXPECT_TRUE(result.rows[3].on_front);
  EXPECT_FALSE(result.rows[4].on_front);
}

TEST(Accuracy, CheapestWithinOnePercent) {
  const AccuracyResult result = made_up();
  EXPECT_EQ(cheapest_within(result, 1.0), 1u);
  EXPECT_EQ(cheapest_within(result, 0.1), std::nullopt);
  EXPECT_THAT(accuracy_sentence(result), testing::HasSubstr("at 0.5 of its cost"));
}

TEST(Accuracy, RunsEachSettingAsAskedAndListsTheRefused) {
  const StudyFiles files;
  const Scene scene = read_scene(files.write("scene.toml", "").parent_path() / "seeder.toml");
  AccuracyGrid grid = default_accuracy_grid(scene);
  EXPECT_EQ(grid.slip_speeds.size(), 2u);
  grid.steps_per_contact = {2, 40};
  grid.shell_compressions = {1e-4};
  grid.integrators = {Integrator::velocity_verlet};
  SweepOptions options;
  options.runs.jobs = 1;
  const Simulator checked = [](const Scene& one, const SimulationOptions& simulation) {
    EXPECT_NEAR(prepare(one).step.contact_duration / *one.numerics.dt, 40, 1e-9);
    return quick_run(one, simulation);
  };
  const AccuracyResult result = measure_accuracy(scene, grid, 2, checked, options);
  ASSERT_EQ(result.rows.size(), 4u);
  EXPECT_FALSE(result.rows[0].mass_rate);
  EXPECT_THAT(result.rows[0].refused, testing::HasSubstr("at most"));
  EXPECT_EQ(result.reference, 2u);
  EXPECT_EQ(result.rows[3].replicates, 2);
  const std::string csv = accuracy_csv(result);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "integrator,dt_s,steps_per_contact,shell_compression,slip_speed_mm_per_s,replicates,rate_g_per_s,rate_ci95,"
            "error_percent,error_ci95,grain_steps,cost_ratio,on_front");
}

}  // namespace
}  // namespace vibrosow
