#include "report/run_page.hpp"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "plan/scene_warnings.hpp"
#include "report/run_data_check.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;

class RunPageData : public testing::Test {
 protected:
  void SetUp() override {
    scene.lots = {{.name = "wheat", .diameter = 4e-3, .mass = 40e-6}};
    scene.contact.shell_compression = 1e-3;
    scene.contact.seed.friction = 0.3;
    scene.tray.name = "tray";
    scene.tray.length = 0.5;
    scene.tray.height = 0.1;
    scene.tray.depth = 0.066;
    scene.tray.holes = {{0.1, 0.016}, {0.2, 0.016}};
    scene.run.duration = 2;
    scene.run.measure_from = 1;
    run.dt = 1e-5;
    run.end_time = 2;
    run.balance = {.put_in = 1000, .inside = 900, .counted = 100};
    for (int k = 0; k < 100; ++k) run.events.push_back({1.003 + 0.01 * k, 1 + k % 2, 0, k, 40e-6, 0.1, 0.6});
  }
  nlohmann::json data() const {
    const Model model = prepare(scene);
    Outflow outflow = measure_outflow(scene, run);
    put_first(scene_warnings(scene), outflow);
    const std::optional<DrillMetrics> drill;
    const std::string expected;
    return nlohmann::json::parse(run_page_data({model, run, outflow, drill, expected}));
  }
  Scene scene;
  vibrosow::Run run;
};

TEST_F(RunPageData, TheHeadlineHasItsIntervalAndThreeMetrics) {
  EXPECT_EQ(
      data()["headline"],
      "2 holes let out 66.0 ± 1.2 g/s, 1650 ± 30 seeds/s (95 %, by blocks of this run), between 1 and 2 s: of the "
      "whole tray, 16.5 times the slice that was simulated, whose holes are slots from front to back.");
  run.events.resize(
      50);  // in five blocks 20, 20, 10, 0 and 0: a standard deviation of half the seeds, Student's t of 4 is 2.78
  EXPECT_EQ(data()["headline"],
            "2 holes let out 33 ± 41 g/s, 800 ± 1000 seeds/s (95 %, by blocks of this run), between 1 and 2 s: of the "
            "whole tray, 16.5 times the slice that was simulated, whose holes are slots from front to back.");
}

TEST_F(RunPageData, WithoutAnIntervalItSaysSo) {
  run.events.clear();
  scene.tray.depth.reset();
  EXPECT_EQ(data()["headline"],
            "2 holes let out 0 g/s, 0 seeds/s (too few for an interval), between 1 and 2 s: of a slice one seed "
            "thick.");
}

TEST_F(RunPageData, DoubtsSayHowSeriousTheyAreAndWhatToDo) {
  run.warnings = {{DoubtKind::guard_warned, "the relative overlap passed 0.05"}};
  const auto remarks = data()["remarks"];
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_EQ(remarks[0]["serious"], true);
  EXPECT_EQ(remarks[0]["text"], "the relative overlap passed 0.05");
  EXPECT_EQ(remarks[0]["what_to_do"], words_of(DoubtKind::guard_warned).advice);
}

TEST_F(RunPageData, SettingsAreWrittenAsAllNumbersAre) {
  run.steps = 123456;
  scene.contact.shell_compression = 3e-5;
  std::map<std::string, std::string> settings;
  const nlohmann::json page = data();
  for (const nlohmann::json& one : page["settings"]) settings[one["name"].get<std::string>()] = one["value"];
  EXPECT_EQ(settings["shell compression"], "0.00003");
  EXPECT_EQ(settings["time step"], "10 \u00b5s");
  EXPECT_EQ(settings["steps"], "123\u202f456");
  EXPECT_EQ(settings["seeds put in"], "1000");
  EXPECT_EQ(page["hole_table"]["rows"][0][2], "100");
}

TEST_F(RunPageData, HolesOneBehindAnotherAreToldApart) {
  const auto names = [&] {
    std::vector<std::string> all;
    const nlohmann::json page = data();
    for (const nlohmann::json& one : page["hole_table"]["columns"]) all.push_back(one["name"].get<std::string>());
    for (const nlohmann::json& row : page["hole_table"]["rows"]) EXPECT_EQ(row.size(), all.size());
    return all;
  };
  EXPECT_THAT(names(), testing::Not(testing::Contains("from the front")));
  scene.space = Space::three_dimensional;
  scene.tray.depth = 0.06;
  scene.tray.holes[0].across = 0.015, scene.tray.holes[1].across = 0.045;
  EXPECT_THAT(names(), testing::Contains("from the front"));
  EXPECT_EQ(data()["hole_table"]["rows"][1][3], "45");
}

TEST_F(RunPageData, WhatCanHardlyBeMeantIsADoubtToo) {
  scene.tray.holes[0].width = 3e-3;  // narrower than a seed
  const auto remarks = data()["remarks"];
  ASSERT_EQ(remarks.size(), 2U) << "once, and that a slice stands for the whole width";
  EXPECT_THAT(remarks[0]["text"].get<std::string>(), testing::StartsWith("tray.holes"));
}

TEST_F(RunPageData, IsWhatACheckOfItTakes) {
  const auto check = [&] { check_run_data(nlohmann::ordered_json::parse(data().dump())); };
  EXPECT_NO_THROW(check());
  scene.space = Space::three_dimensional;
  scene.tray.motion = HarmonicMotion{0, 0.01, 9};
  EXPECT_NO_THROW(check());
  run.status = RunStatus::interrupted, run.end_time = 0, run.steps = 0, run.events.clear();
  EXPECT_NO_THROW(check());
  run.end_time = -1;
  EXPECT_THROW(check(), InputError);
}

TEST_F(RunPageData, MetricsOfTheWholeTrayFrom2DAreRemarkedOn) {
  const auto remarks = data()["remarks"];
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0]["serious"], false);
  EXPECT_THAT(remarks[0]["text"].get<std::string>(), testing::StartsWith("2D stands for the whole depth"));
  scene.tray.depth.reset();
  EXPECT_TRUE(data()["remarks"].empty()) << "then figures are of the slice";
}

}  // namespace
}  // namespace vibrosow
