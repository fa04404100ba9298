#include "picture/ticks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

using testing::ElementsAre;

TEST(Ticks, AreRoundNumbersThatHoldTheValues) {
  EXPECT_THAT(linear_ticks(0, 1).at, ElementsAre(0, 0.2, 0.4, 0.6, 0.8, 1));
  EXPECT_THAT(linear_ticks(0.03, 0.29).at, ElementsAre(0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3));
  EXPECT_THAT(linear_ticks(-7, 13).at, ElementsAre(-10, -5, 0, 5, 10, 15));
  EXPECT_THAT(linear_ticks(13, -7).at, ElementsAre(-10, -5, 0, 5, 10, 15));
  EXPECT_THAT(linear_ticks(2e6, 9e6).at, ElementsAre(2e6, 4e6, 6e6, 8e6, 1e7));
  EXPECT_THAT(linear_ticks(1e-9, 4e-9, 3).at, ElementsAre(1e-9, 2e-9, 3e-9, 4e-9));
}

TEST(Ticks, HoldAnyValuesAndAreFew) {
  for (double low : {-3.7e5, -1.0, 0.0, 1e-12, 0.1234, 99.9})
    for (double span = std::max(1e-7, 1e-6 * std::abs(low)); span < 1e7; span *= 3.3) {  // smaller ones drown in digits
      const Ticks ticks = linear_ticks(low, low + span);
      EXPECT_LE(ticks.low, low + 1e-8 * span);
      EXPECT_GE(ticks.high, low + span * (1 - 1e-8));
      EXPECT_EQ(ticks.at.front(), ticks.low);
      EXPECT_EQ(ticks.at.back(), ticks.high);
      EXPECT_GE(ticks.at.size(), 3U);
      EXPECT_LE(ticks.at.size(), 8U);
    }
}

TEST(Ticks, OfOneValueThereAreTwo) {
  for (const double value : {0.0, 5.0, -3.0, 1e-20}) {
    const Ticks ticks = linear_ticks(value, value);
    EXPECT_LT(ticks.low, ticks.high);
    EXPECT_LE(ticks.low, value);
    EXPECT_GE(ticks.high, value);
  }
}

TEST(Ticks, OfALogarithmicAxisAreDecadesAndPartsOfFew) {
  EXPECT_THAT(logarithmic_ticks(0.003, 40).at, ElementsAre(0.001, 0.01, 0.1, 1, 10, 100));
  EXPECT_THAT(logarithmic_ticks(0.0049, 0.048).at, ElementsAre(0.002, 0.005, 0.01, 0.02, 0.05));
  EXPECT_THAT(logarithmic_ticks(1, 100).at, ElementsAre(1, 2, 5, 10, 20, 50, 100));
  EXPECT_THAT(logarithmic_ticks(3, 3).at, ElementsAre(2, 5));
  EXPECT_THAT(logarithmic_ticks(10, 10).at.size(), testing::Ge(2U));
}

}  // namespace
}  // namespace vibrosow
