#include "report/accuracy_page.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "report/accuracy_report.hpp"
#include "report/kept_page.hpp"
#include "report/page.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

AccuracySetting setting_of(double steps, double softness) {
  return {.steps_per_contact = steps,
          .shell_compression = softness,
          .contact_duration = softness,
          .overlap_at_rest = softness,
          .dt = softness / steps};
}

/// Three settings, of which the last is too long a step; rates in kg/s.
class AccuracyPage : public testing::Test {
 protected:
  static AccuracyRun run_of(std::size_t setting, std::uint64_t seed, double rate, double steps) {
    AccuracyRun run;
    run.setting = setting;
    run.random_seed = seed;
    run.mass_rate = rate;
    run.grain_steps = steps;
    run.cpu_time = steps / 1e7;
    return run;
  }
  AccuracyResult result(int replicates) const {
    std::vector<AccuracyRun> runs;
    for (int r = 0; r < replicates; ++r) {
      const auto seed = static_cast<std::uint64_t>(r) + 1;
      runs.push_back(run_of(0, seed, 0.0100 + 1e-6 * r, 4e7));
      runs.push_back(run_of(1, seed, 0.0108 + 1e-6 * (r % 3), 1e7));
    }
    return accuracy_of({setting_of(40, 1e-4), setting_of(20, 2e-4), setting_of(4, 1e-4)},
                       {"", "", "the step is too long"}, runs);
  }
  nlohmann::json data(int replicates) const {
    return nlohmann::json::parse(accuracy_page_data(scene_, result(replicates)));
  }
  std::vector<nlohmann::json> of_levels(const nlohmann::json& data, const std::string& key) const {
    std::vector<nlohmann::json> values;
    for (const nlohmann::json& level : data["levels"]) values.push_back(level[key]);
    return values;
  }
  Scene scene_;
};

TEST_F(AccuracyPage, EverySettingHasItsErrorAndWhyItHasNone) {
  const auto page = data(4);
  EXPECT_THAT(of_levels(page, "number"), ElementsAre(1, 2, 3));
  EXPECT_THAT(of_levels(page, "finest"), ElementsAre(true, false, false));
  EXPECT_THAT(of_levels(page, "note"), ElementsAre("", "", "the step is too long"));
  EXPECT_NEAR(page["levels"][1]["rate_g_per_s"]["mean"].get<double>(), 10.8, 0.01);
  EXPECT_TRUE(page["levels"][2]["error"].is_null());
  EXPECT_EQ(page["within_percent"], 1.0);
  EXPECT_EQ(page["scene"], nlohmann::json::parse(scene_to_json(scene_)));
  EXPECT_EQ(page["vessels"].size(), 1U);
}

TEST_F(AccuracyPage, TimesAreInTheirOwnFileAndShownByThePage) {
  AccuracyResult slow = result(4);
  for (AccuracyRun& run : slow.runs) run.cpu_time *= 2;
  slow = accuracy_of({slow.rows[0].setting, slow.rows[1].setting, slow.rows[2].setting},
                     {"", "", "the step is too long"}, slow.runs);
  EXPECT_EQ(accuracy_page_data(scene_, slow), accuracy_page_data(scene_, result(4)));

  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "times_of_a_page";
  std::filesystem::create_directory(folder);
  const auto write = [&](const std::vector<OutputFile>& files) {
    for (const OutputFile& file : files) std::ofstream(folder / file.name) << file.content;
  };
  write(timed_page_files("", accuracy_page_data(scene_, slow), "{}"));
  EXPECT_FALSE((*kept_page_data(folder))["levels"][0].contains("cpu_s"));
  write(accuracy_files(slow, {}));
  EXPECT_THAT(of_levels(*kept_page_data(folder), "cpu_s"), ElementsAre(8.0, 2.0, nullptr));
  std::ofstream(folder / "timing.json") << "{}";
  EXPECT_THROW(kept_page_data(folder), InputError);
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(kept_page_data(folder));
}

TEST_F(AccuracyPage, ErrorsAreAgainstTheLimitWhereRunsTellStepFromSoftness) {
  EXPECT_EQ(data(4)["against"], "the finest setting") << "the softer one has another number of steps";
  std::vector<AccuracyRun> runs = result(4).runs;
  for (int r = 0; r < 4; ++r)
    runs.push_back(run_of(2, static_cast<std::uint64_t>(r) + 1, 0.0104 + 1e-6 * (r % 2), 2e7));
  const AccuracyResult of =
      accuracy_of({setting_of(40, 1e-4), setting_of(20, 2e-4), setting_of(20, 1e-4)}, {"", "", ""}, runs);
  ASSERT_TRUE(of.fit);
  const auto page = nlohmann::json::parse(accuracy_page_data(scene_, of));
  EXPECT_THAT(page["against"].get<std::string>(), StartsWith("the limit"));
  EXPECT_EQ(page["levels"][1]["error"]["percent"], of.rows[1].fitted->percent);
  EXPECT_EQ(page["levels"][1]["error"]["band"], of.rows[1].fitted->band);
  EXPECT_FALSE(page["errors"].empty());
}

TEST_F(AccuracyPage, ErrorsAreAgainstTheFinestWhereTheyDoNotWhichIsADoubt) {
  const auto page = data(1);
  EXPECT_EQ(page["against"], "the finest setting");
  EXPECT_NEAR(page["levels"][1]["error"]["percent"].get<double>(), 8, 0.1);
  EXPECT_TRUE(page["errors"].empty());
  EXPECT_THAT(page["remarks"].dump(), HasSubstr("do not determine the limit"));
}

TEST_F(AccuracyPage, APlaneIsADoubtUntilItsErrorIsKnown) {
  const auto is_said = [](const nlohmann::json& page) {
    return page["remarks"].dump().find("--depth") != std::string::npos;
  };
  EXPECT_TRUE(is_said(data(4)));
  scene_.space = Space::three_dimensional;
  EXPECT_FALSE(is_said(data(4)));
}

TEST_F(AccuracyPage, APromiseThatCannotBeKeptSaysWhy) {
  Promise promise;
  promise.settings = {setting_of(40, 1e-4)};
  promise.runs = {run_of(0, 1, 0.01, 4e7)};
  promise.refused = "too few pilots";
  PromiseGoal goal;
  goal.within_percent = 3;
  const auto page = nlohmann::json::parse(accuracy_page_data(scene_, promise, goal));
  EXPECT_THAT(page["headlines"][0].get<std::string>(), HasSubstr("within 3 % cannot be promised: too few pilots"));
  EXPECT_EQ(page["within_percent"], 3.0);
  EXPECT_EQ(page["levels"][0]["chosen"], false);
  EXPECT_THAT(page.dump(), Not(HasSubstr("CPU")));
  const std::vector<OutputFile> files = promise_files(scene_, promise, goal, {});
  const auto times = std::ranges::find(files, "timing.json", &OutputFile::name);
  EXPECT_THAT(times->content, HasSubstr("Cost: 0 pilots 0 s of CPU time."));
  const std::string html =
      timed_page_files("@RECORDING@@REPORT_DATA@", accuracy_page_data(scene_, promise, goal), times->content)[1]
          .content;
  EXPECT_THAT(html, HasSubstr("Cost: 0 pilots"));
}

}  // namespace
}  // namespace vibrosow
