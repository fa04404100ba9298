#include "report/page_charts.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

Json run() {
  return {{"kind", "run"},
          {"title", "A run"},
          {"headline", "Two holes."},
          {"end_time_s", 4.0},
          {"window_s", {1.0, 4.0}},
          {"holes", {{{"hole", 1}}, {{"hole", 2}}}},
          {"events", {{"time_s", {0.5, 1.0, 4.0000001}}, {"hole", {1, 2, 1}}}}};
}

Json accuracy() {
  const auto level = [](int number, const Json& percent, const Json& cpu, bool chosen) {
    Json error = nullptr;
    if (!percent.is_null()) error = {{"percent", percent}, {"band", 0.4}};
    return Json({{"number", number}, {"scheme", "rk2"}, {"error", error}, {"cpu_s", cpu}, {"chosen", chosen}});
  };
  return {{"kind", "accuracy"},
          {"title", "A tray"},
          {"headlines", {"Take 1.", "Or not."}},
          {"within_percent", 1.0},
          {"levels", {level(1, -2.0, 0.5, true), level(2, 0.0, 9.0, false), level(3, nullptr, nullptr, false)}}};
}

Json calibration(bool of_curves) {
  const auto value = [&](double time, bool held_out) {
    return Json({{"time_s", of_curves ? Json(time) : Json(nullptr)},
                 {"held_out", held_out},
                 {"measured", time},
                 {"predicted", time + 1},
                 {"low", time},
                 {"high", time + 2}});
  };
  const Json series = {
      {"conditions", "9 Hz"}, {"hole", "1"}, {"lot", "all"}, {"values", {value(1, false), value(2, true)}}};
  return {{"kind", "calibration"},  {"title", "A slot"},
          {"headline", "Fitted."},  {"quantity", of_curves ? "discharged_percent" : "rate_g_per_s"},
          {"of_curves", of_curves}, {"series", {series}}};
}

TEST(PageCharts, EveryChartOfEveryKindIsDrawnWithItsWords) {
  const std::vector<std::pair<Json, std::vector<std::string>>> all = {
      {run(), {"outflow"}}, {accuracy(), {"precision"}}, {calibration(true), {"fit"}}, {calibration(false), {"fit"}}};
  for (const auto& [data, names] : all) {
    EXPECT_EQ(chart_names(data), names);
    for (const std::string& name : names) {
      const Chart chart = page_chart(data, name);
      const std::string svg = chart_svg(chart, 1280);
      EXPECT_FALSE(chart.sentence.empty()) << name;
      EXPECT_FALSE(chart.series.empty()) << name;
      for (const std::string& words : {chart.x.title, chart.series.front().name})
        EXPECT_THAT(svg, HasSubstr(">" + words + "<")) << name;
      EXPECT_THAT(svg, HasSubstr(">" + (chart.y.rows.empty() ? chart.y.title : chart.y.rows.back()) + "<")) << name;
    }
  }
}

TEST(PageCharts, OutflowEndsAtTheCountsOfTheRun) {
  const Chart chart = page_chart(run(), "outflow");
  ASSERT_EQ(chart.series.size(), 2U);
  EXPECT_EQ(chart.series[0].points.front().y, 0);
  EXPECT_EQ(chart.series[0].points.back().y, 2);
  EXPECT_EQ(chart.series[1].points.back().y, 1);
  EXPECT_EQ(chart.shades.front().of_x.low, 1);
}

TEST(PageCharts, PrecisionIsOfWhatHasAnErrorAndATime) {
  const Chart chart = page_chart(accuracy(), "precision");
  ASSERT_EQ(chart.series.size(), 1U);
  ASSERT_EQ(chart.series[0].points.size(), 2U);
  EXPECT_EQ(chart.series[0].points[0].y, 2);  // of the error its size
  EXPECT_EQ(chart.series[0].points[0].label, "1 (recommended)");
  EXPECT_GT(chart.series[0].points[1].y, 0);
  EXPECT_EQ(chart.sentence, "Take 1. Or not.");
}

TEST(PageCharts, WhatWasHeldOutStandsApart) {
  for (const bool of_curves : {false, true}) {
    const Chart chart = page_chart(calibration(of_curves), "fit");
    EXPECT_EQ(chart.series.back().style, SeriesStyle::hollow_points);
    EXPECT_THAT(chart.series.back().name, HasSubstr("held out"));
    EXPECT_EQ(chart.series.back().points.size(), 1U);
  }
}

TEST(PageCharts, WhatIsNotThereIsToldWithWhatIs) {
  EXPECT_THAT([] { page_chart(run(), "ranking"); },
              testing::ThrowsMessage<InputError>("--chart: there is no \"ranking\" of this folder, but outflow"));
  EXPECT_THROW(page_chart(Json{{"kind", "run"}}, "outflow"), Json::exception);
}

}  // namespace
}  // namespace vibrosow
