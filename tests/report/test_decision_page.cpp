#include "report/study_page.hpp"

#include <nlohmann/json.hpp>

#include "page_data.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Layout 2 is the best of three trays by the most flow; layout 1 misses the rate.
class DecisionPage : public testing::Test {
 protected:
  DecisionPage() {
    DecisionResult& result = report_.result;
    result.study = three_trays();
    result.options.goal = &goal_named("rate");
    result.options.rate = WantedRate{false, 0.01, 0.02};
    result.scenes.resize(2);
    SceneDecision &missing = result.scenes[0], &best = result.scenes[1];
    missing.standing = Standing::misses_the_rate;
    missing.runs = 4;
    missing.goal = MeanWithInterval{0.003, 0.0002};
    best.standing = Standing::best;
    best.runs = 8;
    best.clogged = 2;
    best.goal = MeanWithInterval{0.002, 0.0001};
    best.rate = MeanWithInterval{0.015, 0.001};
    result.best = 1;
    result.is_sure = true;
    result.tests_clogging = true;
    result.cost = {12, 3e6};
  }
  nlohmann::json data() const { return nlohmann::json::parse(page_data(study_page(report_, timing_))); }

  std::vector<std::string> remarks() const {
    std::vector<std::string> texts;
    const nlohmann::json page = data();
    for (const auto& remark : page["remarks"]) texts.push_back(remark["text"]);
    return texts;
  }

  const std::vector<std::string> left_out_ = {"layout 3 cannot be built: hole 3 lies beyond the rim"};
  DecisionReport report_;
  SweepTiming timing_;
};

TEST_F(DecisionPage, SaysTheAnswerWithItsIntervalsAndWhatIsPromised) {
  EXPECT_EQ(
      data()["headline"],
      "Layout 2 (frequency 8 Hz) is the best: rate 2.00 ± 0.10 g/s, 15.0 ± 1.0 g/s of the tray (2D: a slice's rate "
      "times the depth; its holes are slots from front to back), clogged in 2 of 8 runs. "
      "It meets the rate and clogs in fewer than 5 % of runs. With a confidence of 95 %, no other layout "
      "that does so is more than 2 % better.");
  EXPECT_EQ(remarks(), left_out_);
}

TEST_F(DecisionPage, ThePosteriorRuleIsCalledWeak) {
  report_.result.options.rule = SelectionRule::posterior;
  EXPECT_THAT(data()["headline"].get<std::string>(), HasSubstr("posterior probability of 95 %"));
  EXPECT_THAT(remarks()[0], HasSubstr("That is no guarantee"));
  report_.result.is_sure = false;  // then there is no answer to doubt
  EXPECT_EQ(remarks(), left_out_);
}

TEST_F(DecisionPage, NamesThoseThatAreLeftWhereItIsUndecided) {
  DecisionResult& result = report_.result;
  result.is_sure = false;
  result.best = std::nullopt;
  for (SceneDecision& scene : result.scenes) scene.standing = Standing::undecided;
  EXPECT_THAT(data()["headline"].get<std::string>(), HasSubstr("these cannot be told apart"));
  EXPECT_THAT(data()["headline"].get<std::string>(), HasSubstr("constraints: 1, 2."));
  result.is_interrupted = true;
  EXPECT_THAT(data()["headline"].get<std::string>(), HasSubstr("the same command resumes"));
}

TEST_F(DecisionPage, SaysWhereNoLayoutMeetsTheConstraints) {
  report_.result.best = std::nullopt;
  EXPECT_EQ(data()["headline"],
            "With a confidence of 95 %, no layout meets the rate and clogs in fewer than 5 % of runs.");
}

TEST_F(DecisionPage, LayoutsStandAsTheDecisionFoundThem) {
  EXPECT_THAT(of_layouts(data(), "standing"), ElementsAre("misses the rate", "best", "invalid"));
  EXPECT_THAT(of_layouts(data(), "status"), ElementsAre("misses the rate", "ok", "invalid"));
  const auto layouts = data()["layouts"];
  EXPECT_EQ(layouts[2]["note"], "hole 3 lies beyond the rim");
  EXPECT_TRUE(layouts[2]["vessels"].empty());
  EXPECT_FALSE(layouts[2].contains("scene"));
  EXPECT_EQ(layouts[1]["scene"], nlohmann::json::parse(scene_to_json(report_.result.study.scenes[1])));
  EXPECT_EQ(layouts[1]["replicates"], 8);
  EXPECT_EQ(layouts[1]["means"]["rate_g_per_s"], nlohmann::json({{"mean", 2.0}, {"half_width", 0.1}}));
  EXPECT_EQ(layouts[1]["means"]["clogged_percent"]["mean"], 25.0);
  EXPECT_TRUE(layouts[0]["means"]["tray_rate_g_per_s"].is_null());
}

TEST_F(DecisionPage, TheGoalIsTheMetricThatIsJudged) {
  const auto metrics = data()["figures"];
  ASSERT_EQ(metrics.size(), 3U);
  EXPECT_EQ(metrics[0]["name"], "rate_g_per_s");
  EXPECT_EQ(metrics[0]["wanted"], "high");
  EXPECT_EQ(metrics[0]["judged"], true);
  EXPECT_FALSE(metrics[1].contains("judged"));
  EXPECT_EQ(data()["wanted"]["figure"], "tray_rate_g_per_s");
  EXPECT_NEAR(data()["wanted"]["low"].get<double>(), 10, 1e-12);
  EXPECT_NEAR(data()["wanted"]["high"].get<double>(), 20, 1e-12);
  report_.result.options.rate = std::nullopt;  // the rate shown is then the goal itself
  EXPECT_EQ(data()["figures"].size(), 2U);
  EXPECT_FALSE(data().contains("wanted"));
}

TEST_F(DecisionPage, TimeIsOfRunsThatWereMadeNow) {
  const auto about_time = HasSubstr("of this command");
  EXPECT_THAT(data()["cost"].get<std::vector<std::string>>(), Not(Contains(about_time)));
  timing_ = {.wall_time = 31.25, .jobs = 2, .runs = 12};
  EXPECT_THAT(data()["cost"].get<std::vector<std::string>>(),
              Contains("The 12 runs of this command took 31.2 s, up to 2 side by side."));
}

TEST_F(DecisionPage, TheDataEndNoScript) {
  EXPECT_EQ(page_data(study_page(report_, timing_)).find('<'), std::string::npos);
}

TEST_F(DecisionPage, ReplaysAreOfTheBestAndOfThoseNotShownToBeWorse) {
  const auto numbers = [&](std::size_t most) {
    std::vector<int> all;
    for (const WantedReplay& one : best_to_replay(answer_of(report_.result), most)) all.push_back(one.layout);
    return all;
  };
  EXPECT_THAT(numbers(5), ElementsAre(2));
  report_.result.scenes[0].standing = Standing::not_shown_worse;
  EXPECT_THAT(numbers(5), ElementsAre(2, 1));  // the best first, though its mean is less
  EXPECT_THAT(numbers(1), ElementsAre(2));
  report_.result.best = std::nullopt;
  for (SceneDecision& scene : report_.result.scenes) scene.standing = Standing::undecided;
  EXPECT_THAT(numbers(5), ElementsAre(1, 2));  // the most flow first
}

}  // namespace
}  // namespace vibrosow
