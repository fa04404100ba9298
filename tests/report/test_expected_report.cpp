#include "report/expected_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/run_report.hpp"
#include "report/study_page.hpp"
#include "report/sweep_report.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// 6 g/s, a range of half to twice.
ExpectedRate made_up(double chance = 0.02) {
  return {.mass_rate = 6e-3,
          .error = {.chance = deviation_of_half_width(chance),
                    .numerics = deviation_of_half_width(0.01),
                    .tolerance = deviation_of_half_width(0.05),
                    .model = {0.2, 5, 1}},
          .range = {0.5, 2}};
}

TEST(ExpectedText, IsOneLine) {
  EXPECT_EQ(
      expected_sentence(made_up()),
      "6 g/s, expect 3 to 12 g/s until you weigh (95 %); of it chance 2 %, numerics 1 %, tolerance 5 %, model 54 %");
  ExpectedRate slots = made_up();
  slots.knows_tolerance = false;
  EXPECT_THAT(expected_sentence(slots), HasSubstr("numerics 1 %, tolerance not known, model 54 %"));
}

class ExpectedOfASweep : public testing::Test {
 protected:
  StudyResult result(const std::string& more = "") const {
    return sweep(read_study(files_.study("replicates = 3\n[set]\nspace = \"3d\"\n[vary]\ntray.holes.width = "
                                         "[\"14 mm\", \"16 mm\"]\n" +
                                         more)),
                 quick_run, {});
  }
  StudyFiles files_;
};

TEST_F(ExpectedOfASweep, DecidesNothingBetweenItsLayouts) {
  StudyResult swept = result();
  EXPECT_EQ(expected_sentence(answer_of(swept, 1)), "");
  const std::vector<std::size_t> order = answer_of(swept, 1).best_first;
  swept.layouts[0].expected = made_up(0.02), swept.layouts[1].expected = made_up(0.04);
  swept.layouts[1].expected->range.high = 2.2;
  const Answer answer = answer_of(swept, 1);
  EXPECT_THAT(expected_sentence(answer),
              AllOf(HasSubstr("Until you weigh, expect 0.5 to 2.2 times these rates (95 %); of it chance 2 to 4 %, "
                              "numerics 1 %, tolerance 5 %, model 54 %."),
                    HasSubstr("it does not decide between them, and they are compared by chance alone")));
  EXPECT_EQ(answer.best_first, order);
  swept.study.scenes[1].lots[0].diameter *= 2;
  EXPECT_THAT(expected_sentence(answer_of(swept, 1)), HasSubstr("What the model errs by differs from seed to seed"));
}

TEST_F(ExpectedOfASweep, StandsOnItsPageAndInItsTable) {
  StudyResult swept = result();
  swept.layouts[0].expected = made_up();
  const auto page = nlohmann::json::parse(page_data(study_page(swept, 1)));
  EXPECT_THAT(page["expected"].get<std::string>(), HasSubstr("Until you weigh, expect 0.5 to 2 times these rates"));
  EXPECT_THAT(page["layouts"][0]["expected"].get<std::string>(), HasSubstr("6 g/s, expect 3 to 12 g/s"));
  EXPECT_FALSE(page["layouts"][1].contains("expected"));
  const std::string csv = sweep_csv(swept);
  EXPECT_THAT(csv, AllOf(HasSubstr(",expected_low_g_per_s,expected_high_g_per_s,chance_percent,numerics_percent,"
                                   "tolerance_percent,model_percent\n1,"),
                         HasSubstr(",3,12,2,1,5,53.7"), HasSubstr(",,,,,,\n")));
}

TEST_F(ExpectedOfASweep, BesideMeasuredOutflowItIsNotTold) {
  files_.write("measured.csv", "tray.holes.width_mm,hole,seeds_per_s\n14,all,20\n16,all,30\n");
  const StudyResult beside = result("[measured]\nfile = \"measured.csv\"\nscale = \"none\"\n");
  EXPECT_THAT(
      expected_sentence(answer_of(beside, 1)),
      AllOf(HasSubstr("misfit to the measured outflow shows the model's error"), Not(HasSubstr("until you weigh"))));
}

TEST_F(ExpectedOfASweep, OfARunStandsInTheRowOfAllItsHoles) {
  const Study study = read_study(files_.study("[vary]\ntray.holes.width = [\"14 mm\"]\n"));
  const Model model = prepare(study.scenes[0]);
  const auto run = quick_run(model, {});
  const Outflow outflow = measure_outflow(model.scene, run);
  const std::string csv = summary_csv(outflow, {}, made_up());
  EXPECT_THAT(csv,
              AllOf(HasSubstr(",model_percent\n1,"), HasSubstr(",,,,,,\nall,all,"), HasSubstr(",3,12,2,1,5,53.7")));
  EXPECT_THAT(summary_csv(outflow), Not(HasSubstr("expected")));
  const auto json = nlohmann::json::parse(run_json(model.scene, run, outflow, {}, made_up()));
  EXPECT_NEAR(json["outflow"]["expected_high_g_per_s"].get<double>(), 12, 1e-9);
  EXPECT_NEAR(json["outflow"]["chance_percent"].get<double>(), 2, 1e-9);
  EXPECT_TRUE(nlohmann::json::parse(run_json(model.scene, run, outflow, {}))["outflow"]["model_percent"].is_null());
}

}  // namespace
}  // namespace vibrosow
