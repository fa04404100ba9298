#include "agronomy/turn_down.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vibrosow {
namespace {

constexpr double limit = 0.05;

TEST(TurnDown, IsTheLargestOverTheSmallestRateThatWillDo) {
  // 5 Hz clogs; 7 to 11 Hz sow evenly; 13 Hz does not.
  const std::vector<Setting> settings = {{13, 5e-3, true, 0.08, 0.12},
                                         {5, 1e-3, false, 0, 0.02},
                                         {7, 2e-3, true, 0, 0.04},
                                         {9, 3.5e-3, true, 0, 0.03},
                                         {11, 4e-3, true, 0.01, 0.07}};
  const auto may = turn_down(settings, limit, Proof::not_excluded);
  ASSERT_TRUE(may);
  EXPECT_DOUBLE_EQ(may->ratio, 2);
  EXPECT_EQ(may->from, 7);
  EXPECT_EQ(may->to, 11);
  EXPECT_EQ(may->settings, 3);
  const auto shown = turn_down(settings, limit, Proof::shown);  // 11 Hz may be beyond the limit
  EXPECT_DOUBLE_EQ(shown->ratio, 1.75);
  EXPECT_EQ(shown->to, 9);
}

TEST(TurnDown, DoesNotReachAcrossASettingThatWillNot) {
  const std::vector<Setting> settings = {{5, 1e-3},  {7, 1.5e-3}, {9, 0.1e-3, true, 0.2, 0.3},
                                         {11, 3e-3}, {13, 4e-3},  {15, 9e-3}};
  const auto found = turn_down(settings, limit, Proof::shown);
  EXPECT_DOUBLE_EQ(found->ratio, 3);
  EXPECT_EQ(found->from, 11);
  EXPECT_EQ(found->to, 15);
}

/// A range goes as far as its last setting, whatever its rate; of ranges that are as large, the last is told.
TEST(TurnDown, EqualRangesReachToTheLast) {
  const auto flat = turn_down({{5, 1e-3}, {7, 2e-3}, {9, 1.5e-3}}, limit, Proof::shown);
  EXPECT_DOUBLE_EQ(flat->ratio, 2);
  EXPECT_EQ(flat->from, 5);
  EXPECT_EQ(flat->to, 9);
  EXPECT_EQ(flat->settings, 3);
  const auto two = turn_down({{5, 1e-3}, {7, 2e-3}, {9, 1e-3, false}, {11, 2e-3}, {13, 4e-3}}, limit, Proof::shown);
  EXPECT_EQ(two->from, 11);
  EXPECT_EQ(two->to, 13);
  EXPECT_DOUBLE_EQ(two->least_rate, 2e-3);
}

TEST(TurnDown, OfASingleSettingIsOneAndOfNoneNothing) {
  EXPECT_DOUBLE_EQ(turn_down({{9, 2e-3}}, limit, Proof::shown)->ratio, 1);
  EXPECT_FALSE(turn_down({{9, 2e-3, false}}, limit, Proof::not_excluded));
  EXPECT_FALSE(turn_down({{9, 0}}, limit, Proof::not_excluded));
  EXPECT_FALSE(turn_down({{9, 2e-3, true, 0, std::nullopt}}, limit, Proof::shown));  // of too few seeds to know
  EXPECT_TRUE(turn_down({{9, 2e-3, true, 0, std::nullopt}}, limit, Proof::not_excluded));
}

TEST(SlopeSensitivity, IsTheLineOverTheRateOnLevelGround) {
  constexpr double degree = std::numbers::pi / 180;
  // 2 g/s on level ground, 3 % more a degree.
  const auto exact =
      slope_sensitivity({{-10 * degree, 1.4e-3, 0.1e-3}, {0, 2e-3, 0.1e-3}, {10 * degree, 2.6e-3, 0.1e-3}});
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->change * degree, 0.03, 1e-12);
  EXPECT_NEAR(exact->off_line.value(), 0, 1e-12);
  // The ends weigh 1 / 20 degree each: sqrt(2) 0.1 / 20 over 2.
  EXPECT_NEAR(*exact->half_width * degree, 0.1 * std::sqrt(2.0) / 20 / 2, 1e-12);
  const auto bent = slope_sensitivity({{-10 * degree, 2e-3, {}}, {0, 2.3e-3, 1e-4}, {10 * degree, 2e-3, 1e-4}});
  EXPECT_NEAR(bent->change, 0, 1e-12);
  EXPECT_NEAR(bent->off_line.value(), 0.2 / 2.1, 1e-12);
  EXPECT_FALSE(bent->half_width);
}

/// Uphill alone: the rate on level ground is the line's, not the mean of what was measured.
TEST(SlopeSensitivity, IsOverTheLineOnLevelGroundWhereNoTiltWasLevel) {
  const auto uphill = slope_sensitivity({{0.1, 1.8e-3, 1e-4}, {0.2, 1.6e-3, 2e-4}, {0.3, 1.4e-3, 3e-4}});
  ASSERT_TRUE(uphill);
  EXPECT_NEAR(uphill->change, -1, 1e-12);  // 2 g/s on level ground, 2 g/s less in a radian
  // The ends weigh 5 each, the middle nothing.
  EXPECT_NEAR(uphill->half_width.value(), 5 * std::hypot(1e-4, 3e-4) / 2e-3, 1e-12);
  EXPECT_NEAR(uphill->off_line.value(), 0, 1e-12);
}

TEST(SlopeSensitivity, IsOffTheLineBelowItAsAbove) {
  // The line of 3, 1, 3 g/s is 7/3: the middle lies 4/3 below it, the ends 2/3 above.
  EXPECT_NEAR(slope_sensitivity({{-0.1, 3e-3, {}}, {0, 1e-3, {}}, {0.1, 3e-3, {}}})->off_line.value(), 4.0 / 7, 1e-12);
  EXPECT_NEAR(slope_sensitivity({{-0.1, 1e-3, {}}, {0, 3e-3, {}}, {0.1, 1e-3, {}}})->off_line.value(), 4.0 / 5, 1e-12);
}

TEST(SlopeSensitivity, NeedsTwoTiltsAndARate) {
  EXPECT_FALSE(slope_sensitivity({{0, 2e-3, {}}, {0.1, 2.1e-3, {}}})->off_line);  // through two goes a line
  EXPECT_FALSE(slope_sensitivity({}));
  EXPECT_FALSE(slope_sensitivity({{0.1, 2e-3, {}}, {0.1, 2.1e-3, {}}}));
  EXPECT_FALSE(slope_sensitivity({{0, 0, {}}, {0.1, 0, {}}}));
}

}  // namespace
}  // namespace vibrosow
