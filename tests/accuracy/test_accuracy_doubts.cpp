#include "accuracy/accuracy_doubts.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "made_up_rates.hpp"

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
  Scene scene;
  scene.space = space;
  std::vector<DoubtKind> kinds;
  for (const SharedDoubt& doubt : doubts_about(result, scene)) {
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

TEST(AccuracyDoubts, AReferenceThatErrsTooIsOne) {
  AccuracyResult result = result_with(0);
  result.fit.reset();
  EXPECT_THAT(kinds_of(result, Space::three_dimensional), ElementsAre(DoubtKind::no_limit));
}

}  // namespace
}  // namespace vibrosow
