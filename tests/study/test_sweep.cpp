#include "study/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <numbers>

#include "report/sweep_report.hpp"
#include "scene/input_error.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

std::string sweep_runs_csv(const StudyResult& result) {
  SweepRunsCsv csv(result.study);
  for (std::size_t scene = 0; scene < result.runs.size(); ++scene) csv.add(scene, result.runs[scene]);
  return csv.text();
}

using testing::HasSubstr;

SweepOptions with_jobs(int jobs) {
  SweepOptions options;
  options.runs.jobs = jobs;
  return options;
}

Study three_layouts(const StudyFiles& files) {
  return read_study(files.study("replicates = 3\n[vary]\ntray.holes.count = [1, 3, 5]\n"));
}

TEST(Sweep, MeansAndIntervalsAreOfTheReplicates) {
  const StudyFiles files;
  const StudyResult result = sweep(three_layouts(files), quick_run, with_jobs(1));
  // One hole: 11, 12, 13 seeds in 2 s; t(0.975, 2) = 4.3027, sd 0.5.
  const auto& rate = *result.layouts[0].metrics["seeds_per_s"];
  EXPECT_DOUBLE_EQ(rate.mean, 6.0);
  EXPECT_NEAR(*rate.half_width_95, 4.3027 * 0.5 / std::sqrt(3.0), 1e-4);
  EXPECT_FALSE(result.layouts[0].metrics["raw_cv_percent"]);
  EXPECT_TRUE(result.layouts[1].metrics["raw_cv_percent"]);
  EXPECT_EQ(result.layouts[2].replicates, 3);
}

TEST(Sweep, NumberOfJobsDoesNotShow) {
  const StudyFiles files;
  const Study study = three_layouts(files);
  const StudyResult one = sweep(study, quick_run, with_jobs(1));
  const StudyResult two = sweep(study, quick_run, with_jobs(2));
  EXPECT_EQ(sweep_csv(one), sweep_csv(two));
  EXPECT_EQ(sweep_holes_csv(one), sweep_holes_csv(two));
  EXPECT_EQ(sweep_runs_csv(one), sweep_runs_csv(two));
}

TEST(Sweep, FirstRandomSeedActs) {
  const StudyFiles files;
  SweepOptions options = with_jobs(1);
  options.first_random_seed = 11;
  const StudyResult result = sweep(three_layouts(files), quick_run, options);
  EXPECT_EQ(result.runs[0][2].random_seed, 13u);
  EXPECT_DOUBLE_EQ(result.layouts[0].metrics["seeds_per_s"]->mean, 11.0);
}

TEST(Sweep, InterruptKeepsWhatIsFinished) {
  const StudyFiles files;
  std::atomic<bool> interrupt{false};
  std::atomic<int> begun{0};
  const Simulator fifth_is_interrupted = [&](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = quick_run(model, options);
    if (++begun == 5) {
      interrupt = true;
      run.status = RunStatus::interrupted;
    }
    return run;
  };
  SweepOptions options = with_jobs(1);
  options.runs.interrupt = &interrupt;
  const StudyResult result = sweep(three_layouts(files), fifth_is_interrupted, options);
  EXPECT_EQ(begun, 5);
  EXPECT_EQ(result.layouts[0].status, LayoutStanding::ok);
  EXPECT_EQ(result.layouts[1].status, LayoutStanding::incomplete);
  EXPECT_EQ(result.layouts[1].replicates, 1);
  EXPECT_EQ(result.layouts[2].replicates, 0);
  EXPECT_FALSE(result.layouts[2].metrics["rate_g_per_s"]);
  EXPECT_THAT(sweep_csv(result), HasSubstr("\n3,,incomplete,0 of 3 runs finished,5,0,,"));
}

TEST(Sweep, GuardAndRefusalGiveAStatusAndAReason) {
  const StudyFiles files;
  const Simulator troubled = [](const Model& model, const SimulationOptions& options) {
    if (model.scene.tray.holes.size() == 3) throw InputError("the fill does not fit");
    vibrosow::Run run = quick_run(model, options);
    if (model.scene.tray.holes.size() == 5 && options.random_seed == 2) {
      run.status = RunStatus::stopped_by_guard;
      run.stop_reason = "relative overlap 0.6";
    }
    return run;
  };
  const StudyResult result = sweep(three_layouts(files), troubled, with_jobs(1));
  EXPECT_EQ(result.layouts[1].status, LayoutStanding::invalid);
  EXPECT_EQ(result.layouts[1].reason, "the fill does not fit");
  EXPECT_EQ(result.layouts[2].status, LayoutStanding::stopped);
  EXPECT_EQ(result.layouts[2].reason, "random seed 2: relative overlap 0.6");
  EXPECT_EQ(result.layouts[2].replicates, 2);
}

/// Its figures are of the runs that finished, and so are its doubts.
TEST(Sweep, ALayoutOfWhichRunsAreMissingOrStoppedKeepsTheDoubtsOfTheOthers) {
  const StudyFiles files;
  const Study study = read_study(files.study("replicates = 3\n"));
  for (const RunStatus status : {RunStatus::interrupted, RunStatus::stopped_by_guard}) {
    const Simulator last_is_cut_short = [&](const Model& model, const SimulationOptions& options) {
      vibrosow::Run run = quick_run(model, options);
      run.warnings.push_back({DoubtKind::guard_warned, "deep"});
      if (options.random_seed == 3) run.status = status;
      return run;
    };
    const LayoutResult layout = sweep(study, last_is_cut_short, with_jobs(1)).layouts[0];
    EXPECT_FALSE(is_compared(layout.status));
    EXPECT_EQ(layout.replicates, 2);
    EXPECT_THAT(doubts_text(layout.doubts), HasSubstr("the guard warned in 2 of 2 runs"));
  }
}

TEST(Sweep, ALayoutOutsideTheModelDecidesNothing) {
  const StudyFiles files;
  files.write("bench.csv", "tray.holes.count,hole,seeds_per_s\n3,1,12\n3,2,22\n5,1,12\n5,2,22\n");
  const auto study_file = files.study("replicates = 3\n[measured]\nfile = \"bench.csv\"\nscale = \"free\"\n");
  const Study study = read_study(study_file);
  const Simulator soft = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = quick_run(model, options);
    run.outside_the_model = model.scene.tray.holes.size() == 5 && options.random_seed == 2;
    return run;
  };
  const StudyResult result = sweep(study, soft, with_jobs(1));
  ASSERT_EQ(result.layouts.size(), 2u);
  const LayoutResult &within = result.layouts[0], &outside = result.layouts[1];
  EXPECT_EQ(within.status, LayoutStanding::ok);
  EXPECT_TRUE(within.misfit_percent);
  EXPECT_EQ(outside.status, LayoutStanding::outside_the_model);
  EXPECT_THAT(doubts_text(outside.doubts), HasSubstr("outside the model in 1 of 3 runs"));
  EXPECT_THAT(sweep_csv(result), HasSubstr(",outside the model,"));
  EXPECT_FALSE(outside.misfit_percent);
  for (const ComparisonRow& row : result.comparison->rows) EXPECT_EQ(row.layout, 0u);
  files.write("bench.csv", "tray.holes.count,hole,seeds_per_s\n3,1,12\n3,2,22\n");
  const StudyResult alone = sweep(read_study(study_file), quick_run, with_jobs(1));
  EXPECT_EQ(*result.comparison->scale, *alone.comparison->scale) << "nor does it fit the scale";
}

TEST(Sweep, SharedSceneIsRunOnceAndListedUnderEach) {
  const StudyFiles files;
  const Study study = read_study(
      files.study("replicates = 2\n[vary]\ntray.holes.count = [1]\ntray.holes.span = [\"30 cm\", \"36 cm\"]\n"));
  std::atomic<int> runs{0};
  const StudyResult result = sweep(
      study, [&](const Model& model, const SimulationOptions& options) { return ++runs, quick_run(model, options); },
      with_jobs(1));
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(result.layouts[0].metrics["rate_g_per_s"]->mean, result.layouts[1].metrics["rate_g_per_s"]->mean);
  EXPECT_THAT(sweep_runs_csv(result), HasSubstr("same run as of layout 1"));
}

TEST(Sweep, FreeScaleIsFittedAndRatesAreCompared) {
  const StudyFiles files;
  // Means over seeds 1..3 in 2 s: holes 1, 2, 3 give 6, 11, 16 seeds/s; the bench caught twice that.
  files.write("bench.csv", "hole,seeds_per_s\n1,12\n2,22\n3,32\n");
  const Study study = read_study(files.study("replicates = 3\n[measured]\nfile = \"bench.csv\"\nscale = \"free\"\n"));
  const StudyResult result = sweep(study, quick_run, with_jobs(1));
  EXPECT_NEAR(*result.comparison->scale, 2.0, 1e-12);
  EXPECT_NEAR(*result.comparison->misfit_percent, 0.0, 1e-9);
  EXPECT_THAT(comparison_csv(result), HasSubstr("\n1,2,all,,22,22,"));
  EXPECT_NEAR(*result.layouts[0].holes[2].difference_percent, 0.0, 1e-9);
}

/// Hole 1 gives 5.5, 6 and 6.5 seeds/s by random seed, 10, 20 and 30 % more than was caught.
TEST(Sweep, AMisfitsIntervalIsThatOfTheReplicatesMisfits) {
  const StudyFiles files;
  files.write("bench.csv", "hole,seeds_per_s\n1,5\n");
  const Study study = read_study(
      files.study("replicates = 3\n[set]\ntray.holes.count = 1\n[measured]\nfile = \"bench.csv\"\nscale = \"none\"\n"));
  const StudyResult result = sweep(study, quick_run, with_jobs(1));
  const double student = 4.302653 / std::sqrt(3.0);
  EXPECT_NEAR(result.layouts[0].misfit_percent->mean, 20, 1e-9);
  EXPECT_NEAR(*result.layouts[0].misfit_percent->half_width_95, student * 10, 1e-4);
  EXPECT_NEAR(*result.comparison->rows[0].simulated.half_width_95, student * 0.5, 1e-5);
  EXPECT_NEAR(*result.layouts[0].holes[0].difference_percent, 20, 1e-9);
}

TEST(Sweep, CurveIsComparedAtItsTimes) {
  const StudyFiles files;
  files.write("curve.csv", "time_s,seeds\n2,0\n4,12\n");
  const Study study = read_study(
      files.study("replicates = 3\n[set]\ntray.holes.count = 1\n[measured]\nfile = \"curve.csv\"\nscale = \"none\"\n"));
  const StudyResult result = sweep(study, quick_run, with_jobs(1));
  ASSERT_EQ(result.comparison->rows.size(), 2u);
  EXPECT_DOUBLE_EQ(result.comparison->rows[1].simulated.mean, 12.0);
  EXPECT_NEAR(result.layouts[0].misfit_percent->mean, 0.0, 1e-9);
}

TEST(Sweep, ReadingsBeyondTheRunsEndAreRefused) {
  const StudyFiles files;
  files.write("curve.csv", "time_s,seeds\n2,0\n4,12\n9,40\n");
  const auto study = files.study("[measured]\nfile = \"curve.csv\"\nscale = \"none\"\n");
  EXPECT_THAT([&] { read_study(study); },
              testing::ThrowsMessage<InputError>(HasSubstr(
                  "curve.csv:2: time_s: was read up to 9 s, and the run ends 4 s after the curve's time zero")));
}

TEST(Sweep, CurveBeginsWhenTheFirstHoleOpensOrAsTheStudySays) {
  const StudyFiles files;
  files.write("curve.csv", "time_s,seeds\n0,0\n1,5\n2,8\n");
  const std::string study =
      "replicates = 1\n[set]\ntray.holes.count = 1\n%s[measured]\nfile = \"curve.csv\"\nscale = \"none\"\n";
  const auto simulated = [&](const std::string& set, const std::string& more) {
    std::string text = study;
    text.replace(text.find("%s"), 2, set);
    const StudyResult result = sweep(read_study(files.study(text + more)), quick_run, with_jobs(1));
    std::vector<double> means;
    for (const ComparisonRow& row : result.comparison->rows) means.push_back(row.simulated.mean);
    return means;
  };
  // The run lets 11 seeds go evenly from 2 s to 4 s.
  EXPECT_EQ(simulated("", ""), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(simulated("tray.holes.open_at = \"1.5 s\"\n", ""), (std::vector<double>{0, 3, 8}));
  EXPECT_EQ(simulated("", "time_zero = \"1.5 s\"\n"), (std::vector<double>{0, 3, 8}));
  EXPECT_EQ(simulated("tray.holes.open_at = \"1 s\"\n", "time_zero = \"1.9 s\"\n"), (std::vector<double>{0, 5, 10}));
}

/// A grain of each lot in the middle of a tray 50 cm long: the second rises to 3, 4 or 5 cm with the random seed, and
/// the bed's inside, 1 cm deep at the start, holds of it what is left.
vibrosow::Run recorded_run(const Model& model, const SimulationOptions& options) {
  vibrosow::Run run = quick_run(model, options);
  for (const double rise : {0.0, 0.01 * static_cast<double>(options.random_seed)}) {
    Snapshot s;
    s.x = {0.25, 0.25}, s.y = {0.02, 0.02 + rise};
    s.vx = s.vy = s.omega = s.start_x = s.start_y = {0, 0};
    s.lot = {0, 1}, s.id = {0, 1};
    s.radius = {2e-3, 2e-3}, s.mass = {1, 1}, s.area = {1, 1};
    run.snapshots.push_back(s);
  }
  return run;
}

TEST(Sweep, ARecordLeavesItsMetrics) {
  const StudyFiles files;
  const Study study = read_study(files.study(
      "replicates = 3\n[set]\nseeds.weed = { diameter = \"4 mm\", mass = \"40 mg\", number_fraction = \"50 %\" }\n"
      "seeds.wheat.number_fraction = \"50 %\"\nrecord = { times = [\"0 s\", \"1 s\"], cell = \"1 cm\" }\n"
      "tray.holes.count = 1\n"));
  const StudyResult result = sweep(study, recorded_run, with_jobs(2));
  ASSERT_EQ(result.layouts[0].bed.size(), 2u);
  const BedMetrics& end = result.layouts[0].bed[1];
  EXPECT_EQ(end.time, 1);
  // Of random seed k the second lot lies k cm above the first at 2 cm: S = k / (2 + k / 2), 0.4, 2/3 and 6/7.
  ASSERT_EQ(end.segregation.size(), 2u);
  EXPECT_NEAR(end.segregation[1]->mean, (0.4 + 2.0 / 3 + 6.0 / 7) / 3, 1e-12);
  EXPECT_NEAR(end.segregation[0]->mean, -end.segregation[1]->mean, 1e-12);
  // The inside is 25 cm wide, from 1 cm to the upper centre: one disc of 2 mm and half of another at 2 + k cm, against
  // two halves at the start.
  const double disc = 4e-6 * std::numbers::pi;
  EXPECT_NEAR(result.layouts[0].bed[0].packing->mean, disc / (0.25 * 0.01), 1e-12);
  const double mean = 1.5 * disc / 0.25 * (1 / 0.02 + 1 / 0.03 + 1 / 0.04) / 3;
  EXPECT_NEAR(end.packing->mean, mean, 1e-12);
  EXPECT_NEAR(end.packing_change->mean, mean - disc / (0.25 * 0.01), 1e-12);
  const std::string csv = sweep_records_csv(result);
  EXPECT_THAT(csv, HasSubstr("layout,name,record,time_s,lot,replicates,packing_fraction,packing_fraction_ci95,"
                             "packing_change,packing_change_ci95,segregation,segregation_ci95\n"));
  EXPECT_THAT(csv, HasSubstr("\n1,,2,1,weed,3,,,,,"));
  EXPECT_THAT(csv, HasSubstr("\n1,,1,0,all,3,0.00502655,0,0,0,,\n"));
}

TEST(SweepReport, ColumnsAreTheDocumentedOnes) {
  const StudyFiles files;
  const Study study = read_study(files.study("[vary]\ntray.holes.span = [\"30 cm\"]\n"));
  const std::string csv = sweep_csv(sweep(study, quick_run, with_jobs(1)));
  EXPECT_EQ(
      csv.substr(0, csv.find('\n')),
      "layout,name,status,reason,tray.holes.span_mm,replicates,rate_g_per_s,rate_g_per_s_ci95,seeds_per_s,"
      "seeds_per_s_ci95,depth_factor,tray_rate_g_per_s,tray_rate_g_per_s_ci95,tray_rate_g_per_min,"
      "tray_rate_g_per_min_ci95,tray_seeds_per_s,tray_seeds_per_s_ci95,raw_cv_percent,run_cv_percent,"
      "run_cv_percent_ci95,chance_cv_percent,unevenness_cv_percent,unevenness_cv_percent_low,"
      "unevenness_cv_percent_high,instability_cv_percent,"
      "instability_cv_percent_ci95,longest_pause_s,longest_pause_s_ci95,spilled_percent,spilled_percent_ci95,"
      "misfit_percent,misfit_percent_ci95,expected_low_g_per_s,expected_high_g_per_s,chance_percent,numerics_percent,"
      "tolerance_percent,model_percent");
}

TEST(Sweep, RunsThatAreDroppedGiveTheSameReports) {
  const StudyFiles files;
  const Study study =
      read_study(files.study("replicates = 900\n[vary]\n\"tray.holes.width\" = [\"14 mm\", \"15 mm\", \"16 mm\", "
                             "\"14 mm\", \"13 mm\", \"12 mm\"]\n"));
  const StudyResult kept = sweep(study, quick_run, {});
  SweepOptions options;
  SweepRunsCsv runs(study);
  options.on_runs = [&](std::size_t scene, const std::vector<Evaluation>& of_scene) { runs.add(scene, of_scene); };
  const StudyResult dropped = sweep(study, quick_run, options);
  EXPECT_TRUE(dropped.runs.back().empty());
  EXPECT_EQ(runs.text(), sweep_runs_csv(kept));
  EXPECT_EQ(sweep_csv(dropped), sweep_csv(kept));
  EXPECT_EQ(sweep_holes_csv(dropped), sweep_holes_csv(kept));
}

}  // namespace
}  // namespace vibrosow
