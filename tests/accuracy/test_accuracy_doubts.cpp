#include "accuracy/accuracy_doubts.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "made_up_rates.hpp"
#include "report/accuracy_report.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

AccuracyResult result_with(double by_interaction) {
  const AccuracyDesign design = made_up_design();
  return accuracy_of(
      design.settings, std::vector<std::string>(design.settings.size()),
      MadeUpRuns({.scatter = 0.5, .by_interaction = by_interaction}).run(design.settings, rounds_of(design, 4)));
}

std::vector<DoubtKind> kinds_of(const AccuracyResult& result, Space space) {
  std::vector<DoubtKind> kinds;
  for (const SharedDoubt& doubt : doubts_about(result, sound_scene(space))) {
    kinds.push_back(doubt.kind);
    EXPECT_TRUE(doubt.layouts.empty()) << "of the answer itself";
  }
  return kinds;
}

TEST(AccuracyDoubts, ASoundFitInSpaceHasNone) {
  EXPECT_THAT(kinds_of(result_with(0), Space::three_dimensional), IsEmpty());
}

TEST(AccuracyDoubts, ThePlanesOwnErrorIsOneUntilItIsMeasured) {
  AccuracyResult result = result_with(0);
  EXPECT_THAT(kinds_of(result, Space::two_dimensional), ElementsAre(DoubtKind::depth_left_out));
  result.depth = DepthError{};
  EXPECT_THAT(kinds_of(result, Space::two_dimensional), IsEmpty());
}

TEST(AccuracyDoubts, PartsOfASettingThatActOnEachOtherAreOne) {
  EXPECT_THAT(kinds_of(result_with(12), Space::three_dimensional), ElementsAre(DoubtKind::errors_interact));
}

TEST(AccuracyDoubts, WhatCanHardlyBeMeantInTheSceneIsOneOfTableAndPromise) {
  const AccuracyResult result = result_with(0);
  Scene still = sound_scene();
  still.contact = {};
  const auto is_told_once = [](const std::vector<SharedDoubt>& doubts) {
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0].kind, DoubtKind::unlikely_scene);
    EXPECT_TRUE(doubts[0].layouts.empty()) << "of the answer itself";
    EXPECT_THAT(doubts[0].text, testing::StartsWith("tray.motion: the tray stands still"));
  };
  is_told_once(doubts_about(result, still));
  Promise made;
  made.settings = made_up_design().settings;
  made.runs = result.runs;
  EXPECT_THAT(promise_text(still, made, {.within_percent = 3}),
              testing::HasSubstr("tray.motion: the tray stands still"));
}

TEST(AccuracyDoubts, AReferenceThatErrsTooIsOne) {
  AccuracyResult result = result_with(0);
  result.fit.reset();
  EXPECT_THAT(kinds_of(result, Space::three_dimensional), ElementsAre(DoubtKind::no_limit));
}

}  // namespace
}  // namespace vibrosow
