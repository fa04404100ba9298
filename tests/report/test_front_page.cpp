#include "report/study_page.hpp"

#include <nlohmann/json.hpp>

#include "page_data.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Layout 1 is on the front of longest pause and power, layout 2 may be.
class FrontPage : public testing::Test {
 protected:
  FrontPage() {
    result_.study = three_trays();
    result_.options.goals = read_front_goals({"pause", "power"});
    result_.layouts.resize(3);
    FrontLayout &sure = result_.layouts[0], &unsure = result_.layouts[1];
    sure.standing = FrontStanding::on_front;
    sure.is_first_by_means = true;
    sure.runs = 4;
    sure.clogged = 1;
    sure.goals = {MeanWithInterval{0.2, 0.05}, MeanWithInterval{3, std::nullopt}};
    unsure.standing = FrontStanding::may_be_on_front;
    unsure.runs = 2;
    unsure.goals = {MeanWithInterval{0.1, 0.2}, MeanWithInterval{4, std::nullopt}};
    unsure.rate = MeanWithInterval{0.002, 0.0001};
    result_.cost = {6, 2e6};
  }
  nlohmann::json data() const { return nlohmann::json::parse(page_data(study_page(result_, SweepTiming{}))); }
  std::string headline() const { return data()["headline"]; }

  OptimiseResult result_;
};

TEST_F(FrontPage, SaysHowManyAreOnTheFront) {
  EXPECT_EQ(headline(), "1 layout is on the front of longest pause and power, of 3 that were tried; 1 more may be.");
  result_.layouts[1].standing = FrontStanding::dominated;
  EXPECT_EQ(headline(), "1 layout is on the front of longest pause and power, of 3 that were tried.");
  result_.layouts[0].standing = FrontStanding::may_be_on_front;
  EXPECT_EQ(headline(),
            "1 layout may be on the front of longest pause and power, of 3 that were tried; none is shown to be.");
  result_.layouts[0].standing = FrontStanding::clogs;
  EXPECT_EQ(headline(), "No layout of 3 that were tried is known to meet the constraints.");
}

TEST_F(FrontPage, DoubtsAreWhatIsNotPromisedAndThatItWasInterrupted) {
  const auto remark = [&](std::size_t k) { return data()["remarks"][k]["text"].get<std::string>(); };
  ASSERT_EQ(data()["remarks"].size(), 3U) << "and that a layout cannot be built";
  EXPECT_EQ(remark(0),
            "Of the 1 that may be on the front, none surely meets the constraints; more runs (--runs) may decide.");
  EXPECT_THAT(remark(1), HasSubstr("is not promised"));
  result_.layouts[1].surely_meets = true;
  EXPECT_THAT(remark(0), HasSubstr("each is not shown to be better in some goal than every other"));
  result_.is_interrupted = true;
  EXPECT_THAT(remark(0), HasSubstr("Interrupted"));
}

TEST_F(FrontPage, LayoutsHaveTheirGoalsInTheirUnits) {
  EXPECT_THAT(of_layouts(data(), "standing"), ElementsAre("on the front", "may be on the front", "invalid"));
  EXPECT_THAT(of_layouts(data(), "status"), ElementsAre("ok", "ok", "invalid"));
  EXPECT_THAT(of_layouts(data(), "first_by_means"), ElementsAre(true, false, false));
  const auto layouts = data()["layouts"];
  EXPECT_EQ(layouts[0]["means"]["longest_pause_s"], nlohmann::json({{"mean", 0.2}, {"half_width", 0.05}}));
  EXPECT_TRUE(layouts[0]["means"]["power_W_per_kg"]["half_width"].is_null());
  EXPECT_EQ(layouts[0]["means"]["clogged_percent"]["mean"], 25.0);
  EXPECT_EQ(layouts[1]["means"]["rate_g_per_s"]["mean"], 2.0);
  EXPECT_FALSE(layouts[2].contains("means"));
  EXPECT_TRUE(layouts[0]["at_edge"].empty());
  result_.layouts[0].at_edge = {"tray.motion.frequency"};
  EXPECT_EQ(data()["layouts"][0]["at_edge"], nlohmann::json::array({0})) << "the places of its keys";
}

TEST_F(FrontPage, ReplaysAreOfThoseThatLead) {
  const auto numbers = [&](std::size_t most) {
    std::vector<int> all;
    for (const WantedReplay& one : best_to_replay(answer_of(result_), most)) all.push_back(one.layout);
    return all;
  };
  EXPECT_THAT(numbers(5), ElementsAre(1));
  result_.layouts[1].is_first_by_means = true;
  EXPECT_THAT(numbers(5), ElementsAre(1, 2));
  EXPECT_THAT(numbers(1), ElementsAre(1));
}

TEST_F(FrontPage, GoalsAreMarkedAndSayWhatIsWanted) {
  result_.options.goals = read_front_goals({"rate", "power"});
  const auto metrics = data()["figures"];
  ASSERT_EQ(metrics.size(), 3U);  // the rate is a goal, and stands there once
  EXPECT_EQ(metrics[0]["wanted"], "high");
  EXPECT_EQ(metrics[1]["wanted"], "low");
  EXPECT_EQ(metrics[1]["goal"], true);
  EXPECT_FALSE(metrics[2].contains("goal"));
  EXPECT_EQ(data().contains("wanted"), result_.options.rate.has_value());
}

}  // namespace
}  // namespace vibrosow
