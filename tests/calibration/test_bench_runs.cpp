#include "calibration/bench_runs.hpp"

#include <gtest/gtest.h>

#include "scene/input_error.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

class BenchRunsOf : public testing::Test {
 protected:
  BenchRunsOf() {
    std::string stiff = StudyFiles::seeder_text();
    const std::string usual = "shell_compression = 1e-3";
    stiff.replace(stiff.find(usual), usual.size(), "shell_compression = 1e-6");
    files_.write("seeder.toml", stiff);
    asked_.seeder = files_.seeder();
    asked_.overrides = {parse_override("tray.holes.count=1"), parse_override("tray.motion.kind=\"harmonic\""),
                        parse_override("tray.motion.direction=0 degree"), parse_override("tray.motion.frequency=9 Hz"),
                        parse_override("tray.motion.amplitude=1 cm")};
  }
  BenchRuns bench(double budget = 1e9) const {
    return affordable_bench(asked_, std::make_shared<SourceFiles>(), budget);
  }

  StudyFiles files_;
  BenchAsked asked_{};
};

TEST_F(BenchRunsOf, AreSixtyOfTheSeederAsItIsWrittenWhereThatIsCheap) {
  const BenchRuns all = bench();
  EXPECT_EQ(all.design.runs.size(), 60U);
  EXPECT_FALSE(all.is_draft);
  EXPECT_EQ(all.task.measured.table.condition_keys.size(), 2U);
  EXPECT_TRUE(all.left_out.empty());
}

TEST_F(BenchRunsOf, AreDraftsWhereTheyCostTooMuch) {
  asked_.keys = {parse_fitted_key("contact.friction=0.2..0.8")};
  const BenchRuns all = bench();
  const BenchRuns draft = bench(all.seconds / 2);
  EXPECT_TRUE(draft.is_draft);
  EXPECT_EQ(draft.design.runs.size(), 60U);
  EXPECT_LT(draft.seconds, all.seconds / 5);  // 300 times softer, so some 17 times fewer steps
  EXPECT_EQ(draft.design.runs.front().scene.numerics.accuracy, AccuracyLevel::draft);
}

TEST_F(BenchRunsOf, AreFewerWhereDraftsCostTooMuch) {
  asked_.keys = {parse_fitted_key("contact.friction=0.2..0.8")};
  const double draft = bench(bench().seconds / 2).seconds;
  const BenchRuns fewer = bench(0.6 * draft);
  EXPECT_TRUE(fewer.is_draft);
  EXPECT_LE(fewer.seconds, 0.6 * draft);
  EXPECT_GT(fewer.seconds, 0.5 * draft);
  EXPECT_EQ(fewer.task.measured.table.condition_keys.size(), 2U);
}

TEST_F(BenchRunsOf, AreOfOneSettingBeforeTheyAreRefused) {
  asked_.keys = {parse_fitted_key("contact.friction=0.2..0.8")};
  const double a_run = bench(bench().seconds / 2).seconds / 60;
  const BenchRuns one = bench(a_run * (fewest_bench_runs(3) - 1.5));
  EXPECT_EQ(one.left_out, std::vector<std::string>{"tray.motion.amplitude"});
  EXPECT_EQ(one.task.measured.table.condition_keys, std::vector<std::string>{"tray.motion.frequency"});
  EXPECT_LE(one.seconds, a_run * (fewest_bench_runs(3) - 1.5));
  try {
    bench(a_run);
    FAIL() << "runs that cannot be afforded are made";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a sheet needs at least 11 runs"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("tray.motion.frequency alone"), std::string::npos) << error.what();
  }
}

/// What says how stiff seeds are contradicts a level: then there are fewer runs.
TEST_F(BenchRunsOf, KeepTheStiffnessThatIsAskedFor) {
  asked_.overrides.erase(asked_.overrides.begin());
  asked_.keys = {parse_fitted_key("contact.shell_compression=1e-6..1e-5")};
  EXPECT_FALSE(bench(0.6 * bench().seconds).is_draft);
  asked_.keys = {parse_fitted_key("contact.friction=0.2..0.8")};
  asked_.overrides.push_back(parse_override("numerics.steps_per_contact=20"));
  EXPECT_FALSE(bench(0.6 * bench().seconds).is_draft);
}

TEST_F(BenchRunsOf, AreNotFewerThanTheSurrogateNeeds) {
  asked_.most_runs = 12;
  EXPECT_THROW(bench(), InputError);
}

}  // namespace
}  // namespace vibrosow
