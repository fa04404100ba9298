#include "calibration/calibration_answer.hpp"

#include <gmock/gmock.h>

#include "support/made_up_calibration.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CalibrationAnswerOf : public MadeUpCalibration {
 protected:
  std::vector<std::string> doubts() const {
    std::vector<std::string> texts;
    for (const SharedDoubt& doubt : answer().doubts) texts.push_back(sentence_of(remark_of(doubt)));
    return texts;
  }
};

TEST_F(CalibrationAnswerOf, HasNoDoubtWhereAllIsWell) {
  EXPECT_THAT(doubts(), IsEmpty());
}

TEST_F(CalibrationAnswerOf, NamesWhatCannotBeToldApart) {
  calibration_.correlations[1].correlation = -0.93;
  EXPECT_THAT(doubts(),
              ElementsAre(testing::StartsWith("Note: contact.friction and depth_factor cannot be told apart by this "
                                              "table (correlation -0.93). What to do: ")));
}

TEST_F(CalibrationAnswerOf, NamesWhatIsDoubtful) {
  calibration_.values[1].contraction = 0.05;
  calibration_.misfit_probability = 1e-4;
  calibration_.posterior.effective_points = 50;
  calibration_.held_out_rms.reset();
  runs_ = {{"clogged", {}, {}}, {"", {}, {}}};
  EXPECT_THAT(doubts(),
              ElementsAre(testing::StartsWith("Doubtful: the model nowhere meets the table"),
                          HasSubstr("the table says little of contact.restitution"), HasSubstr("50 effective points"),
                          HasSubstr("1 of 2 runs were left out"), HasSubstr("nothing was held out")));
}

/// 0.1 to 0.8 is a range of 0.7, of which two hundredths are near an edge.
TEST_F(CalibrationAnswerOf, AValueAtTheEdgeOfItsRangeIsSaidToBeAndGivesNoContact) {
  EXPECT_TRUE(answer().gives_a_contact);
  calibration_.values[0] = {.mean = 0.76, .low = 0.7, .high = 0.787, .contraction = 0.6};
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("contact.friction lies at the upper edge of its range, 0.1 to 0.8")));
  EXPECT_FALSE(answer().gives_a_contact);
  calibration_.values[0].high = 0.785;
  EXPECT_THAT(doubts(), IsEmpty());
  calibration_.values[0] = {.mean = 0.13, .low = 0.113, .high = 0.2, .contraction = 0.6};
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("lower edge")));
  calibration_.values[0].contraction = 0.1;  // then it reaches to both: nothing is known of it
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("the table says little of")));
}

/// Of a range from 1 to 100 along which logarithms are even, 2 % at each end are up to 1.0965 and from 91.2 on.
TEST_F(CalibrationAnswerOf, AnEdgeOfALogarithmicRangeIsAPartOfIt) {
  task_.keys[0] = {.key = "contact.friction", .low = 1, .high = 100, .logarithmic = true};
  const auto edge = [&](double low, double high) {
    calibration_.values[0] = {.mean = 10, .low = low, .high = high, .contraction = 0.3};
    return answer().numbers[0].edge;
  };
  EXPECT_EQ(edge(1.09, 20), RangeEdge::lower);
  EXPECT_EQ(edge(1.11, 20), RangeEdge::none);
  EXPECT_EQ(edge(5, 92), RangeEdge::upper);
  EXPECT_EQ(edge(5, 90), RangeEdge::none);
}

TEST_F(CalibrationAnswerOf, AMisfitThatDwarfsTheNoiseIsNoFit) {
  calibration_.misfit_probability = 1e-9, calibration_.misfit_over_noise = 2.9;
  EXPECT_TRUE(answer().is_fitted);
  EXPECT_FALSE(answer().gives_a_contact);
  calibration_.misfit_over_noise = 3.1;
  EXPECT_FALSE(answer().is_fitted);
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("miss it by 3.1 times its noise. Nothing was fitted")));
}

TEST_F(CalibrationAnswerOf, AContractionBelowNothingIsExplained) {
  calibration_.values[1].contraction = -0.2;
  EXPECT_THAT(doubts(), testing::Contains(HasSubstr("contact.restitution scatters more than an even spread")));
}

TEST_F(CalibrationAnswerOf, RunsThatLostSeedsGiveNoContact) {
  runs_ = {{"", {}, {{DoubtKind::guard_warned, "deep"}}}};  // which is said
  EXPECT_TRUE(answer().gives_a_contact);
  runs_.push_back({"", {}, {{DoubtKind::seeds_lost, "2 of 9 seeds lost through walls"}}});
  EXPECT_FALSE(answer().gives_a_contact);
  runs_.back().reason = "clogged";  // it does not count
  EXPECT_TRUE(answer().gives_a_contact);
}

/// A condition's scene is looked at once, whatever is fitted.
TEST_F(CalibrationAnswerOf, SaysWhatIsUnlikelyInItsScenes) {
  CalibrationRun run{0, 0, 1, {}};
  run.scene.lots = {SeedLot{.name = "lead", .diameter = 4e-3, .mass = 1e-3}};
  run.scene.tray.motion = HarmonicMotion{.amplitude = 3e-3, .frequency = 10};
  design_.conditions.resize(2);
  design_.runs = {run, run, run};
  design_.runs[2].condition = 1;
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("seeds.lead: its mass and size")));
}

TEST_F(CalibrationAnswerOf, LotsWithContactsOfTheirOwnGetNoFileForAll) {
  CalibrationRun run{0, 0, 1, {}};
  for (const char* name : {"pea", "barley"})
    run.scene.lots.push_back({.name = name, .number_fraction = 0.5, .contact = {name, std::string("models/") + name}});
  run.scene.tray.motion = HarmonicMotion{.amplitude = 3e-3, .frequency = 10};
  run.scene.contact.overrides = {{1, -1, {.friction = 0.2}}};
  design_.conditions.resize(1);
  design_.runs = {run};
  EXPECT_TRUE(answer().lots_have_own_contacts);
  EXPECT_FALSE(answer().gives_a_contact);
  design_.runs[0].scene.contact.model = {{"mine", "mine.toml"}};
  EXPECT_TRUE(answer().gives_a_contact) << "all lots have that";
}

}  // namespace
}  // namespace vibrosow
