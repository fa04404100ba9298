#include "report/run_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace vibrosow {
namespace {

class RunReport : public testing::Test {
 protected:
  void SetUp() override {
    scene.title = "Two holes";
    scene.lots = {{.name = "wheat", .diameter = 4e-3, .mass = 40e-6}};
    scene.tray.name = "tray";
    scene.tray.length = 0.5;
    scene.tray.depth = 0.06;
    scene.tray.holes = {{0.1, 0.016}, {0.2, 0.016}};
    scene.run.duration = 2;
    scene.run.measure_from = 1;
    run.dt = 1e-3;
    run.steps = 2000;
    run.end_time = 2;
    run.grain_steps = 6000;
    run.wall_time = 0.5;
    run.measured_cpu_time = 0.3;
    run.balance = {.put_in = 3, .inside = 1, .counted = 1, .spilled = 1};
    run.tray_at_begin = 30, run.tray_at_end = 10;
    run.events = {{1.5, 2, 0, 17, 40e-6, 0.201, 0.6264}, {1.75, 0, 0, 18, 40e-6, -0.0035, 0.5}};
  }
  Scene scene;
  vibrosow::Run run;
};

TEST_F(RunReport, OutflowHasARowPerGrainAndNamesTheSpilled) {
  EXPECT_EQ(outflow_csv(scene, run),
            "time_s,hole,lot,grain,mass_g,x_mm,speed_m_per_s\n"
            "1.5,2,wheat,17,0.04,201,0.6264\n"
            "1.75,spilled,wheat,18,0.04,-3.5,0.5\n");
}

TEST_F(RunReport, SummaryHasPlaneAndTrayRates) {
  EXPECT_EQ(
      summary_csv(measure_outflow(scene, run)),
      "hole,lot,position_mm,width_mm,grains,mass_g,seeds_per_s,rate_g_per_s,longest_pause_s,depth_factor,"
      "tray_rate_g_per_s,tray_seeds_per_s,note\n"
      "1,wheat,100,16,0,0,0,0,1,15,0,0,drained in the window: 20 of the 30 seeds in the tray gone; a rate from 1 seed\n"
      "2,wheat,200,16,1,0.04,1,0.04,0.5,15,0.6,15,drained in the window: 20 of the 30 seeds in the tray gone; a rate "
      "from 1 seed\n"
      "all,all,,,1,0.04,1,0.04,0.5,15,0.6,15,drained in the window: 20 of the 30 seeds in the tray gone; a rate from 1 "
      "seed\n");
}

TEST_F(RunReport, SummaryIsEmptyWhereUndefined) {
  scene.tray.depth.reset();
  run.status = RunStatus::interrupted;
  run.end_time = 0.5, run.tray_at_begin = -1;
  run.events.clear();
  EXPECT_NE(summary_csv(measure_outflow(scene, run))
                .find("\n1,wheat,100,16,0,0,,,,,,,interrupted; ended before the measuring window\n"),
            std::string::npos);
}

TEST_F(RunReport, JsonHoldsTheRunAndNoClock) {
  run.warnings = {{DoubtKind::guard_warned, "relative overlap 0.06"}};
  run.energy.kinetic = std::numeric_limits<double>::quiet_NaN();
  const Outflow outflow = measure_outflow(scene, run);
  const std::string text = run_json(scene, run, outflow, {"friction", "motion"});
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["status"], "finished");
  EXPECT_EQ(json["effects"], (std::vector<std::string>{"friction", "motion"}));
  EXPECT_EQ(json["grain_steps"], 6000);
  EXPECT_EQ(json["balance"]["spilled"], 1);
  const auto& doubt = json["doubts"][1];  // after the drained tray
  EXPECT_EQ(doubt["kind"], "the guard warned");
  EXPECT_EQ(doubt["text"], "relative overlap 0.06");
  EXPECT_EQ(doubt["serious"], true);
  EXPECT_NE(doubt["what_to_do"], "");
  EXPECT_TRUE(json["energy_J"]["kinetic"].is_null());
  EXPECT_EQ(json["outflow"]["spilled_percent"], 50);
  EXPECT_EQ(json["outflow"]["window_s"], (std::vector<double>{1, 2}));
  EXPECT_TRUE(json["scene"].is_object());
  EXPECT_FALSE(json["versions"]["box2d"].get<std::string>().empty());
  run.wall_time = 99;
  EXPECT_EQ(run_json(scene, run, outflow, {"friction", "motion"}), text);
}

TEST_F(RunReport, TimingIsApart) {
  const auto json = nlohmann::json::parse(timing_json(run));
  EXPECT_EQ(json["wall_s"], 0.5);
  EXPECT_EQ(json["measured_cpu_s"], 0.3);
  EXPECT_EQ(json["grain_steps_per_s"], 12000);
  EXPECT_FALSE(json.contains("fractions"));  // not asked for
  run.phase_times.emplace();
  run.phase_times->at(static_cast<std::size_t>(Phase::pairs)) = 0.2;
  const auto fractions = nlohmann::json::parse(timing_json(run))["fractions"];
  EXPECT_EQ(fractions.size(), phase_names.size());
  EXPECT_DOUBLE_EQ(fractions["pairs"], 0.4);
  run.wall_time = 0;
  EXPECT_TRUE(nlohmann::json::parse(timing_json(run))["grain_steps_per_s"].is_null());
}

TEST_F(RunReport, HasFourFilesAllDocumented) {
  std::vector<std::string> names, documented;
  for (const OutputFile& file : run_files(scene, run, measure_outflow(scene, run), {})) names.push_back(file.name);
  for (const FileText& text : run_file_texts()) documented.push_back(text.name);
  EXPECT_EQ(names, (std::vector<std::string>{"outflow.csv", "summary.csv", "run.json", "timing.json"}));
  EXPECT_TRUE(std::equal(names.begin(), names.end(), documented.begin()));
}

TEST_F(RunReport, SpreadsheetsWithADecimalCommaGetSemicolons) {
  scene.lots[0].name = "wheat 1.5";  // a name stays as it is
  EXPECT_EQ(outflow_csv(scene, run, semicolon_csv),
            "time_s;hole;lot;grain;mass_g;x_mm;speed_m_per_s\n"
            "1,5;2;wheat 1.5;17;0,04;201;0,6264\n"
            "1,75;spilled;wheat 1.5;18;0,04;-3,5;0,5\n");
}

}  // namespace
}  // namespace vibrosow
