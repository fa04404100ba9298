#include "study/trade.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/sweep_report.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::Not;

/// The small seeder with a motion and a drill.
Study with_drill(const StudyFiles& files, const std::string& study) {
  files.write("sown.toml", "title = \"Sown\"\n" + files.seeder_text() + R"([tray.motion]
kind = "harmonic"
amplitude = "1 cm"
frequency = "9 Hz"
[drill]
row_spacing = "15 cm"
speed = "7.2 km/h"
)");
  return read_study(files.write("study.toml", "base = \"sown.toml\"\nreplicates = 3\n" + study));
}

StudyResult swept(const Study& study, const Simulator& simulator = quick_run) {
  SweepOptions options;
  options.runs.jobs = 1;
  return sweep(study, simulator, options);
}

/// 40 seeds a Hz from each hole in the 2 s of the window, a degree of tilt more or less of 2 %; clogs below 6 Hz.
vibrosow::Run by_frequency(const Model& model, const SimulationOptions& options) {
  const Scene& scene = model.scene;
  const double frequency = std::get<HarmonicMotion>(*scene.tray.motion).frequency;
  const double tilt = scene.tray.tilt * 180 / std::numbers::pi;
  vibrosow::Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3;
  run.steps = 4000;
  run.end_time = scene.run.duration;
  if (frequency < 6) run.end_reason = "no seed left for 1 s", run.balance.inside = 20;
  for (int hole = 1; hole <= 3; ++hole) {
    const int seeds = static_cast<int>(std::lround(40 * frequency * (1 + 0.02 * tilt)));
    for (int i = 0; i < seeds; ++i)
      run.events.push_back({2.0 + 2.0 * (i + 0.5) / seeds, hole, 0, run.balance.counted++, 40e-6, 0.1, 0.5});
  }
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);
  run.balance.inside += 100000;  // so many stay that the tray has not drained
  run.balance.put_in = run.balance.counted + run.balance.inside;
  return run;
}

TEST(Trade, LayoutsThatDifferInTheDrillShareRuns) {
  const StudyFiles files;
  const StudyResult result = swept(with_drill(files, "[vary]\ndrill.speed = [\"7.2 km/h\", \"14.4 km/h\"]\n"));
  EXPECT_EQ(result.study.scenes.size(), 1u);
  ASSERT_EQ(result.layouts.size(), 2u);
  // Hole 1: 11, 12 and 13 seeds in 2 s of a slice, 15 slices: 90 seeds/s a row; over 0.15 m and 2 m/s 300 to the m2.
  const RowMeans &slow = result.layouts[0].rows[0], &fast = result.layouts[1].rows[0];
  EXPECT_DOUBLE_EQ(slow["seeds_per_s"]->mean, 90);
  EXPECT_NEAR(slow["seeds_per_m2"]->mean, 300, 1e-9);
  EXPECT_NEAR(fast["seeds_per_m2"]->mean, 150, 1e-9);
  EXPECT_DOUBLE_EQ(fast["seeds_per_s"]->mean, 90);
  EXPECT_EQ(result.layouts[0].rows.size(), 4u);
  EXPECT_TRUE(trade_lines(result).empty());
}

TEST(Trade, RowsAndTradeAreFilesOfAStudyWithADrillAlone) {
  const StudyFiles files;
  const StudyResult bare = swept(read_study(files.study("replicates = 2\n")));
  const auto names = [](const StudyResult& result) {
    std::vector<std::string> found;
    for (const OutputFile& file : sweep_files(answer_of(result, 1), result, SweepRunsCsv(result.study), {}))
      found.push_back(file.name);
    return found;
  };
  EXPECT_THAT(names(bare), Not(testing::Contains("sweep_rows.csv")));
  const StudyResult sown =
      swept(with_drill(files, "[vary]\ntray.motion.frequency = [\"7 Hz\", \"9 Hz\"]\n"), by_frequency);
  EXPECT_THAT(names(sown), testing::IsSupersetOf({"sweep_rows.csv", "trade.csv"}));
}

TEST(Trade, TurnDownIsOfTheFrequenciesThatFlow) {
  const StudyFiles files;
  const StudyResult result =
      swept(with_drill(files, "[vary]\ntray.motion.frequency = [\"5 Hz\", \"7 Hz\", \"14 Hz\"]\n"), by_frequency);
  EXPECT_EQ(result.layouts[0].stopped_flowing, 3) << "of whose runs seeds are left";
  const auto lines = trade_lines(result);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].key, "tray.motion.frequency");
  EXPECT_EQ(lines[0].layouts.size(), 3u);
  ASSERT_TRUE(lines[0].not_excluded);
  EXPECT_NEAR(lines[0].not_excluded->ratio, 2, 1e-9);
  EXPECT_EQ(lines[0].not_excluded->from, 7);
  EXPECT_EQ(lines[0].unsound, 0u) << "what stopped flowing is known not to do";
  EXPECT_FALSE(lines[0].slope);
}

TEST(Trade, TurnDownLeavesOutWhatIsSeriouslyDoubted) {
  const StudyFiles files;
  const StudyResult result =
      swept(with_drill(files, "[vary]\ntray.motion.frequency = [\"7 Hz\", \"10 Hz\", \"14 Hz\"]\n"),
            [](const Model& model, const SimulationOptions& options) {
              vibrosow::Run run = by_frequency(model, options);
              if (std::get<HarmonicMotion>(*model.scene.tray.motion).frequency > 12)
                run.warnings.push_back({DoubtKind::guard_warned, "the overlap was large"});
              return run;
            });
  ASSERT_TRUE(is_serious(result.layouts[2].doubts));
  const auto lines = trade_lines(result);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_TRUE(lines[0].not_excluded);
  EXPECT_NEAR(lines[0].not_excluded->ratio, 10.0 / 7, 1e-9);
  EXPECT_EQ(lines[0].unsound, 1u);
}

TEST(Trade, SlopeIsOfTheTiltsAndEachFrequencyIsALine) {
  const StudyFiles files;
  const StudyResult result = swept(with_drill(files, R"([vary]
tray.tilt = ["-5 degree", "0 degree", "5 degree"]
tray.motion.frequency = ["10 Hz", "20 Hz"]
)"),
                                   by_frequency);
  const auto lines = trade_lines(result);
  ASSERT_EQ(lines.size(), 5u);  // two of the tilt, three of the frequency
  EXPECT_EQ(lines[0].key, "tray.tilt");
  EXPECT_EQ(lines[0].layouts, (std::vector<std::size_t>{0, 2, 4}));
  ASSERT_TRUE(lines[0].slope);
  EXPECT_NEAR(lines[0].slope->change * std::numbers::pi / 180, 0.02, 1e-9);
  EXPECT_NEAR(lines[0].slope->off_line.value(), 0, 1e-9);
  EXPECT_NEAR(lines[3].not_excluded->ratio, 2, 1e-9);
}

/// At 5 degrees the guard warned, so that two tilts are left; at 5 Hz all clogs, and none is.
TEST(Trade, SlopeIsOfSoundRatesAlone) {
  const StudyFiles files;
  const StudyResult result = swept(with_drill(files, R"([vary]
tray.tilt = ["-5 degree", "0 degree", "5 degree"]
tray.motion.frequency = ["5 Hz", "10 Hz"]
)"),
                                   [](const Model& model, const SimulationOptions& options) {
                                     vibrosow::Run run = by_frequency(model, options);
                                     if (model.scene.tray.tilt > 0.01)
                                       run.warnings.push_back({DoubtKind::guard_warned, "the overlap was large"});
                                     return run;
                                   });
  const auto lines = trade_lines(result);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[0].is_slope);
  EXPECT_EQ(lines[0].unsound, 3u);
  EXPECT_FALSE(lines[0].slope);
  EXPECT_EQ(lines[1].unsound, 1u);
  ASSERT_TRUE(lines[1].slope);
  EXPECT_NEAR(lines[1].slope->change * std::numbers::pi / 180, 0.02, 1e-9);
  EXPECT_FALSE(lines[1].slope->off_line) << "a line goes through two";
}

}  // namespace
}  // namespace vibrosow
