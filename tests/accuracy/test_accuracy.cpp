#include "accuracy/accuracy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>

#include "input/read_scene.hpp"
#include "plan/step_plan.hpp"
#include "report/accuracy_report.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

AccuracyRow row(Integrator integrator, double steps, double compression, double rate, double grain_steps,
                double interval = 0.03) {
  AccuracyRow made;
  made.setting.integrator = integrator;
  made.setting.steps_per_contact = steps;
  made.setting.shell_compression = compression;
  made.setting.dt = 1e-5;
  made.mass_rate = MeanWithInterval{rate, interval * rate};
  made.grain_steps = grain_steps;
  made.replicates = 5;
  return made;
}

AccuracyResult compared(std::vector<AccuracyRow> rows) {
  AccuracyResult result;
  result.rows = std::move(rows);
  compare_with_finest(result);
  return result;
}

constexpr Integrator verlet = Integrator::velocity_verlet;

AccuracyResult made_up() {
  return compared({row(verlet, 40, 1e-4, 1.000, 1000), row(verlet, 20, 1e-4, 1.005, 500),
                   row(Integrator::rk2_midpoint, 20, 1e-4, 1.004, 500), row(verlet, 20, 1e-3, 0.95, 100),
                   row(verlet, 10, 1e-3, 0.90, 200)});
}

/// Of a study's seeder with other keys.
Scene scene_of(const StudyFiles& files, const std::vector<Override>& overrides = {}) {
  return read_scene(files.write("scene.toml", "").parent_path() / "seeder.toml", overrides);
}

SweepOptions one_job() {
  SweepOptions options;
  options.runs.jobs = 1;
  return options;
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

TEST(Accuracy, FrontHoldsWhatErrsLessThanAllThatIsCheaper) {
  const AccuracyResult result = made_up();
  EXPECT_TRUE(result.rows[3].on_front);
  EXPECT_TRUE(result.rows[1].on_front);   // 0.5 against 5 %, 4.2 % by chance
  EXPECT_FALSE(result.rows[0].on_front);  // the reference costs twice as much as what is not told apart from it
  EXPECT_FALSE(result.rows[2].on_front);
  EXPECT_FALSE(result.rows[4].on_front);
}

TEST(Accuracy, TiesDoNotStandOnTheFront) {
  const AccuracyResult result =
      compared({row(verlet, 40, 1e-4, 1.00, 1000, 0.001), row(verlet, 20, 1e-4, 1.01, 500, 0.001),
                row(verlet, 20, 2e-4, 1.01, 400, 0.001), row(verlet, 20, 3e-4, 0.99, 600, 0.001),
                row(verlet, 10, 3e-4, 1.01, 400, 0.001), row(verlet, 5, 1e-4, 0.90, 400, 0.001),
                row(verlet, 40, 2e-4, 1.0095, 700, 0.001)});
  EXPECT_TRUE(result.rows[0].on_front);
  EXPECT_FALSE(result.rows[1].on_front);  // as good as the third and dearer
  EXPECT_TRUE(result.rows[2].on_front);
  EXPECT_FALSE(result.rows[4].on_front);  // its equal, and later
  EXPECT_FALSE(result.rows[5].on_front);  // costs as much and errs more
  EXPECT_FALSE(result.rows[6].on_front);  // 0.05 % better, 0.14 % by chance
}

/// Of two rates near 1.01, each known to 0.1 % of itself, a difference of 0.1427 % is chance.
TEST(Accuracy, ErrsLessByMoreThanBothIntervalsLeaveOpen) {
  const auto on_front = [](double less) {
    return compared({row(verlet, 40, 1e-4, 1.00, 1000, 0.001), row(verlet, 20, 1e-4, 1.01, 400, 0.001),
                     row(verlet, 20, 2e-4, 1.01 - less, 600, 0.001)})
        .rows[2]
        .on_front;
  };
  EXPECT_FALSE(on_front(0.00142));
  EXPECT_TRUE(on_front(0.00143));
}

TEST(Accuracy, SlipSpeedIsLeftOutOfTheTableWhereFrictionHasNone) {
  const StudyFiles files;
  const Scene scene = scene_of(files, {parse_override("contact.friction_model=spring")});
  AccuracyGrid grid = default_accuracy_grid(scene);
  grid.integrators = {verlet};
  grid.steps_per_contact = {20, 40};
  grid.shell_compressions = {1e-4};
  const AccuracyResult result = measure_accuracy(scene, full_design(grid), 2, quick_run, one_job());
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_THAT(accuracy_table(result), testing::Not(testing::HasSubstr("slip")));
  EXPECT_THAT(accuracy_sentence(result), testing::Not(testing::HasSubstr("slip")));
  EXPECT_THAT(accuracy_csv(result), testing::HasSubstr(",20,0.0001,,,2,"));
}

TEST(Accuracy, EveryRunIsListedWithARandomSeedOfItsOwn) {
  const StudyFiles files;
  const Scene scene = scene_of(files);
  AccuracyGrid grid = default_accuracy_grid(scene);
  grid.integrators = {verlet};
  grid.steps_per_contact = {20, 40};
  grid.shell_compressions = {1e-4};
  grid.slip_speeds = {0.02};
  SweepOptions options = one_job();
  options.first_random_seed = 7;
  const AccuracyResult result = measure_accuracy(scene, full_design(grid), 2, quick_run, options);
  std::vector<std::uint64_t> seeds;
  std::vector<std::size_t> settings;
  for (const AccuracyRun& run : result.runs) seeds.push_back(run.random_seed), settings.push_back(run.setting);
  EXPECT_THAT(seeds, testing::ElementsAre(7, 8, 9, 10));
  EXPECT_THAT(settings, testing::ElementsAre(0, 1, 0, 1));  // in turn
  const std::string csv = accuracy_runs_csv(result);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
  EXPECT_EQ(
      csv.substr(0, csv.find('\n')),
      "integrator,dt_s,steps_per_contact,shell_compression,youngs_modulus_MPa,slip_speed_mm_per_s,window,random_seed,"
      "rate_g_per_s,grain_steps,reason");
}

TEST(Accuracy, RunsOutsideTheModelHaveNoRate) {
  const StudyFiles files;
  const Scene scene = scene_of(files);
  AccuracyGrid grid = default_accuracy_grid(scene);
  grid.integrators = {verlet};
  grid.steps_per_contact = {20};
  grid.shell_compressions = {1e-4, 1e-3};
  grid.slip_speeds = {0.02};
  const Simulator soft_is_outside = [](const Model& model, const SimulationOptions& simulation) {
    vibrosow::Run run = quick_run(model, simulation);
    run.outside_the_model = model.scene.contact.shell_compression > 5e-4;
    return run;
  };
  const AccuracyResult result = measure_accuracy(scene, full_design(grid), 2, soft_is_outside, one_job());
  EXPECT_TRUE(result.rows[0].mass_rate);
  EXPECT_FALSE(result.rows[1].mass_rate);
  EXPECT_EQ(result.rows[1].refused, "outside the model");
  EXPECT_FALSE(result.rows[1].on_front);
}

TEST(Accuracy, RecommendsTheCheapestWhoseFittedErrorAndBandStayWithin) {
  AccuracyResult result = made_up();
  const RateError errors[] = {{0.1, 0.3}, {0.4, 0.5}, {0.3, 0.4}, {-3, 0.5}, {0.7, 0.5}};
  for (std::size_t i = 0; i < result.rows.size(); ++i) result.rows[i].fitted = errors[i];
  EXPECT_EQ(cheapest_within(result, 1.0), 1u);
  EXPECT_EQ(cheapest_within(result, 3.5), 3u);
  EXPECT_EQ(cheapest_within(result, 1.2), 4u);
  EXPECT_EQ(cheapest_within(result, 0.3), std::nullopt);
}

TEST(Accuracy, TableFitsATerminal) {
  AccuracyResult result = made_up();
  for (AccuracyRow& one : result.rows) one.setting.slip_speed = 0.02;
  AccuracyRow& wide = result.rows[1];
  wide.setting = {Integrator::velocity_verlet, 1234.5, 1.23456e-5, 0, 0.0123456, 0, 0, 1.234e-05};
  wide.mass_rate->mean = 1.23456e-05, wide.fitted = RateError{-123.45, 123.45}, wide.cost_ratio = 1.234e-05;
  AccuracyRow& refused = result.rows[2];
  refused.mass_rate.reset();
  refused.refused = "too long, at most 1.234e-05 s: the shell's vibration with the damping of its dashpots (Verlet)";
  std::istringstream table(accuracy_table(result));
  for (std::string line; std::getline(table, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_THAT(accuracy_table(result), testing::HasSubstr("\nrk2-midpoint\n"));
}

TEST(Accuracy, InterruptedBeforeTheFinestSettingGivesNoErrors) {
  const StudyFiles files;
  AccuracyGrid grid = default_accuracy_grid(scene_of(files));
  grid.integrators = {verlet};
  grid.steps_per_contact = {20, 40};
  grid.slip_speeds = {0.02};
  SweepOptions options = one_job();
  std::atomic<bool> interrupt{false};
  options.runs.interrupt = &interrupt;
  int begun = 0;
  const Simulator third_is_interrupted = [&](const Model& model, const SimulationOptions& simulation) {
    vibrosow::Run run = quick_run(model, simulation);
    if (++begun == 3) interrupt = true, run.status = RunStatus::interrupted;
    return run;
  };
  const AccuracyResult result = measure_accuracy(scene_of(files), full_design(grid), 2, third_is_interrupted, options);
  ASSERT_TRUE(result.rows.front().mass_rate);
  for (const AccuracyRow& one : result.rows) {
    EXPECT_FALSE(one.error_percent);
    EXPECT_FALSE(one.on_front);
  }
  EXPECT_EQ(result.rows[result.reference].setting.steps_per_contact, 40);
  EXPECT_THAT(accuracy_sentence(result), testing::HasSubstr("has no result (interrupted)"));
  EXPECT_THAT(accuracy_table(result), testing::Not(testing::HasSubstr("reference")));
}

TEST(Accuracy, HertzIsSoftenedByYoungsModulusInItsOwnColumn) {
  const StudyFiles files;
  files.write("seeder.toml", R"([seeds.wheat]
diameter = "4 mm"
mass = "40 mg"
number_fraction = "50 %"
[seeds.weed]
diameter = "4 mm"
mass = "40 mg"
number_fraction = "50 %"
youngs_modulus = "100 MPa"
[contact]
law = "hertz"
youngs_modulus = "500 MPa"
friction = 0.3
[contact.wall]
youngs_modulus = "2000 MPa"
[tray]
length = "50 cm"
height = "12 cm"
fill = { count = 40, packing = "layers" }
holes = { count = 1, width = "16 mm" }
[run]
duration = "4 s"
)");
  const Scene scene = scene_of(files);
  AccuracyGrid grid = default_accuracy_grid(scene);
  EXPECT_TRUE(grid.shell_compressions.empty());
  AccuracySetting soft{.youngs_modulus = 5e6};
  const Scene softened = scene_with(scene, soft);
  EXPECT_EQ(softened.contact.youngs_modulus, 5e6);
  EXPECT_DOUBLE_EQ(*softened.lots[1].youngs_modulus, 1e6);
  EXPECT_DOUBLE_EQ(*softened.contact.wall_youngs_modulus, 2e7);

  grid.integrators = {verlet};
  grid.steps_per_contact = {40};
  grid.slip_speeds = {0.1};
  grid.youngs_moduli = {5e8, 5e7, 5e6};
  const AccuracyResult result = measure_accuracy(scene, full_design(grid), 1, quick_run, one_job());
  ASSERT_EQ(result.rows.size(), 3u);
  EXPECT_EQ(result.reference, 0u);
  EXPECT_THAT(accuracy_table(result),
              testing::AllOf(testing::HasSubstr("E MPa"), testing::Not(testing::HasSubstr("eps/r"))));
  EXPECT_THAT(accuracy_csv(result), testing::HasSubstr(",40,,50,100,1,"));
}

TEST(Accuracy, RunsEachSettingAsAskedAndListsTheRefused) {
  const StudyFiles files;
  const Scene scene = scene_of(files);
  AccuracyGrid grid = default_accuracy_grid(scene);
  EXPECT_EQ(grid.slip_speeds.size(), 2u);
  grid.steps_per_contact = {2, 40};
  grid.shell_compressions = {1e-4};
  grid.integrators = {verlet};
  const Simulator checked = [](const Model& model, const SimulationOptions& simulation) {
    EXPECT_NEAR(model.step.contact_duration / *model.scene.numerics.dt, 40, 1e-9);
    return quick_run(model, simulation);
  };
  const AccuracyResult result = measure_accuracy(scene, full_design(grid), 2, checked, one_job());
  ASSERT_EQ(result.rows.size(), 4u);
  EXPECT_FALSE(result.rows[0].mass_rate);
  EXPECT_THAT(result.rows[0].refused, testing::HasSubstr("at most"));
  EXPECT_EQ(result.reference, 2u);
  EXPECT_EQ(result.rows[3].replicates, 2);
  const std::string csv = accuracy_csv(result);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "integrator,dt_s,steps_per_contact,shell_compression,youngs_modulus_MPa,slip_speed_mm_per_s,replicates,"
            "rate_g_per_s,rate_ci95,error_percent,error_ci95,fitted_error_percent,fitted_error_band95,grain_steps,cost_"
            "ratio,on_front");
}

}  // namespace
}  // namespace vibrosow
