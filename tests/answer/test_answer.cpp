#include "answer/answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace vibrosow {
namespace {

using enum LayoutStanding;
using testing::ElementsAre;
using testing::IsEmpty;

/// A study of four layouts, of which the third cannot be built.
Study four_layouts() {
  Study study;
  study.scenes.resize(3);
  for (int number = 1; number <= 4; ++number) {
    Layout layout;
    layout.number = number;
    if (number == 3)
      layout.invalid = "a hole lies beyond the rim";
    else
      layout.scene = static_cast<std::size_t>(number < 3 ? number - 1 : 2);
    study.layouts.push_back(layout);
  }
  return study;
}

std::vector<LayoutStanding> standings_in(const Answer& answer) {
  std::vector<LayoutStanding> standings;
  for (const AnsweredLayout& one : answer.layouts) standings.push_back(one.standing);
  return standings;
}

CountedDoubt doubt(int runs) {
  return {DoubtKind::guard_warned, runs, 5, "too soft"};
}

TEST(Answer, OfADecisionNamesTheDoubtsOfThoseThatMayBeTheBest) {
  DecisionResult result;
  result.study = four_layouts();
  result.options.goal = &goal_named("rate");
  result.scenes.resize(3);
  const auto set = [&](std::size_t scene, Standing standing, double mean) {
    SceneDecision& of = result.scenes[scene];
    of.standing = standing, of.runs = 4, of.clogged = 1, of.goal = MeanWithInterval{mean, 0.1};
    of.doubts = {doubt(static_cast<int>(scene) + 1)};
  };
  set(0, Standing::not_shown_worse, 3), set(1, Standing::worse, 1), set(2, Standing::best, 2.9);
  result.best = 2;
  const Answer answer = answer_of(result);
  EXPECT_THAT(standings_in(answer), ElementsAre(not_shown_worse, worse, invalid, best));
  EXPECT_EQ(answer.layouts[2].reason, "a hole lies beyond the rim");
  EXPECT_THAT(answer.best_first, ElementsAre(3, 0)) << "the best, though another's mean is higher";
  ASSERT_EQ(answer.metrics.size(), 2u) << "the goal is the rate that is shown";
  EXPECT_EQ(answer.metrics[0].wanted, Wanted::high);
  EXPECT_DOUBLE_EQ(answer.layouts[1].values[1]->mean, 0.25);
  const std::vector<SharedDoubt> doubts = doubts_about(answer);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_THAT(doubts[0].layouts, ElementsAre(1, 4)) << "what is worse is not the answer's doubt";
  EXPECT_EQ(doubts[0].runs, 1 + 3);
  result.scenes[0].is_screened_out = true;
  EXPECT_THAT(standings_in(answer_of(result)), ElementsAre(ruled_out_by_drafts, worse, invalid, best));
}

TEST(Answer, OfASearchSaysWhatAConstraintIs) {
  OptimiseResult result;
  result.study = four_layouts();
  result.options.goals = read_front_goals({"power", "rate"});
  result.layouts.resize(4);
  for (FrontLayout& of : result.layouts) of.standing = FrontStanding::misses_a_band;
  result.layouts[3].standing = FrontStanding::may_be_on_front;
  result.layouts[3].is_first_by_means = true, result.layouts[3].runs = 2, result.layouts[3].goals.resize(2);
  EXPECT_THAT(standings_in(answer_of(result)), ElementsAre(spills, spills, invalid, may_be_on_front));
  result.options.rate = WantedRate{.is_of_seeds = false, .low = 1, .high = 2};
  EXPECT_EQ(answer_of(result).layouts[0].standing, misses_the_rate);
  result.options.spilled_limit = 0.1;
  EXPECT_EQ(answer_of(result).layouts[0].standing, misses_the_rate_or_spills);
  const Answer answer = answer_of(result);
  EXPECT_THAT(answer.best_first, ElementsAre(3));
  EXPECT_TRUE(answer.layouts[3].is_named);
  EXPECT_EQ(answer.layouts[3].values.size(), answer.metrics.size());
  EXPECT_THAT(answer.layouts[0].values, IsEmpty()) << "it has no runs";
}

TEST(Answer, OfASweepRanksWhatMayBeComparedByItsRate) {
  StudyResult result;
  result.study = four_layouts();
  result.layouts.resize(4);
  const double rates[] = {1, 3, 0, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    Outflow outflow;
    HoleOutflow& all = outflow.holes.emplace_back();
    all.hole = all.lot = "all";
    all.mass_rate = rates[i];
    if (i != 2) result.layouts[i].metrics = MetricMeans({&outflow});
  }
  result.layouts[1].status = LayoutStanding::outside_the_model;
  result.layouts[2].status = LayoutStanding::invalid;
  result.layouts[3].status = LayoutStanding::doubtful;
  const Answer answer = answer_of(result, 7);
  EXPECT_EQ(answer.first_random_seed, 7u);
  EXPECT_THAT(standings_in(answer), ElementsAre(ok, outside_the_model, invalid, doubtful));
  EXPECT_THAT(answer.best_first, ElementsAre(3, 0));
  EXPECT_EQ(std::ranges::find(answer.metrics, "unevenness_cv_percent", &AnswerMetric::name), answer.metrics.end())
      << "no layout has it";
}

TEST(LayoutStandings, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (int k = 0; k <= static_cast<int>(invalid); ++k) names.insert(name_of(static_cast<LayoutStanding>(k)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(invalid) + 1);
  EXPECT_TRUE(is_compared(worse));
  EXPECT_FALSE(is_compared(clogs));
}

}  // namespace
}  // namespace vibrosow
