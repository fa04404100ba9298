#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/study_page.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A study with an answer about it, of one figure in g/s or of two.
class StudyCharts : public testing::Test {
 protected:
  StudyCharts() { study_.title = "Trays <b>"; }
  void add(const std::string& name, LayoutStanding standing, std::vector<std::optional<MeanWithInterval>> values) {
    Layout layout;
    layout.number = static_cast<int>(study_.layouts.size()) + 1;
    layout.name = name;
    study_.layouts.push_back(layout);
    page_.answer.layouts.push_back(
        {.layout = study_.layouts.size() - 1, .standing = standing, .values = std::move(values)});
  }
  static std::optional<MeanWithInterval> grams(double mean, double half_width) {
    return MeanWithInterval{1e-3 * mean, 1e-3 * half_width};
  }
  /// Four layouts, of which the third was stopped, and one without a value.
  void sweep() {
    page_.answer.metrics = {
        {.name = "seeds_per_s", .unit = "1/s"},
        {.name = "rate_g_per_s", .unit = "g/s", .unit_size = 1e-3, .wanted = Wanted::high, .is_goal = true}};
    const double rates[] = {2, 5, 9, 3};
    for (int k = 0; k < 4; ++k)
      add(k == 1 ? "slow & <wide>" : "", k == 2 ? LayoutStanding::stopped : LayoutStanding::ok,
          {std::nullopt, grams(rates[k], 0.5)});
    add("", LayoutStanding::incomplete, {std::nullopt, std::nullopt});
  }
  void search() {
    page_.answer.kind = AnswerKind::search;
    page_.answer.metrics = {
        {.name = "power_W_per_kg", .unit = "W/kg", .wanted = Wanted::low, .is_goal = true},
        {.name = "run_cv_percent", .unit = "%", .unit_size = 1e-2, .wanted = Wanted::low, .is_goal = true}};
    for (const auto standing : {LayoutStanding::on_front, LayoutStanding::dominated})
      add("", standing, {MeanWithInterval{3, 1}, MeanWithInterval{0.08, 0.02}});
    page_.answer.layouts[0].is_named = true;
  }
  Chart chart(const std::string& name) const { return study_chart(page_, name); }

  Study study_;
  StudyPage page_{.answer = {.kind = AnswerKind::sweep, .study = &study_}, .headline = "4 layouts."};
};

TEST_F(StudyCharts, ARankingStandsInTheOrderOfThePageTheOnesThatAreNotComparedLast) {
  sweep();
  EXPECT_THAT(chart_names(page_), ElementsAre("ranking"));
  const Chart ranking = chart("ranking");
  EXPECT_THAT(ranking.y.rows, ElementsAre("2: slow & <wide>", "4", "1", "3"));
  ASSERT_EQ(ranking.series.size(), 2U);
  EXPECT_EQ(ranking.series[1].style, SeriesStyle::hollow_points);
  EXPECT_DOUBLE_EQ(ranking.series[0].points[0].of_x->low, 4.5);
  EXPECT_DOUBLE_EQ(ranking.shades.front().of_x.high, 5.5);
  EXPECT_EQ(ranking.x.title, "rate, g/s (bars: 95 % intervals)");
  EXPECT_EQ(ranking.sentence, "4 layouts.");
  EXPECT_THAT(chart_svg(ranking, 800), HasSubstr("slow &amp; &lt;wide&gt;"));
}

TEST_F(StudyCharts, ALongRankingSaysHowMuchOfItIsShown) {
  sweep();
  for (int k = 0; k < 60; ++k) add("", LayoutStanding::ok, {std::nullopt, grams(1, 0.1)});
  EXPECT_EQ(chart("ranking").y.rows.size(), 40U);
  EXPECT_EQ(chart("ranking").sentence, "4 layouts. Shown: the first 40 of 64.");
}

TEST_F(StudyCharts, AFrontHasTheIntervalsOfThoseThatLead) {
  search();
  EXPECT_THAT(chart_names(page_), ElementsAre("front", "ranking"));
  const Chart front = chart("front");
  EXPECT_EQ(front.y.title, "run CV, %");
  ASSERT_EQ(front.series.size(), 2U);
  EXPECT_EQ(front.series[0].name, "on the front");
  EXPECT_EQ(front.series[0].points[0].label, "1");
  EXPECT_DOUBLE_EQ(front.series[0].points[0].of_y->high, 10);
  EXPECT_FALSE(front.series[1].points[0].of_y);
}

TEST_F(StudyCharts, WhatIsNotThereIsToldWithWhatIs) {
  search();
  EXPECT_THAT([&] { chart("outflow"); }, testing::ThrowsMessage<InputError>(
                                             "--chart: there is no \"outflow\" of this folder, but front, ranking"));
  for (AnsweredLayout& one : page_.answer.layouts) one.values.clear();
  EXPECT_THROW(chart("ranking"), InputError);
}

}  // namespace
}  // namespace vibrosow
