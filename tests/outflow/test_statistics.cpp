#include <gtest/gtest.h>

#include <cmath>

#include "outflow/statistics.hpp"

namespace vibrosow {
namespace {

TEST(MeanWithInterval, UsesStudentsTOfTheTables) {
  // s = 1.581139, t(0.975, 4) = 2.776445 (any printed table): 2.776445 * 1.581139 / sqrt(5)
  const auto five = mean_with_interval({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(five.mean, 3);
  ASSERT_TRUE(five.half_width_95);
  EXPECT_NEAR(*five.half_width_95, 1.963243, 1e-6);

  // t(0.975, 1) = 12.7062, s = sqrt(2), n = 2
  EXPECT_NEAR(*mean_with_interval({4, 6}).half_width_95, 12.7062, 1e-4);
  EXPECT_NEAR(*mean_of_rates({{4, 4}, {6, 6}}).half_width_95, 12.7062, 1e-4);
  EXPECT_NEAR(*mean_of_rates({{5, 5}, {5, 5}}).half_width_95, 12.7062 / std::sqrt(24), 1e-4);
  EXPECT_EQ(mean_of_rates({{5, 0}, {5, 0}}).half_width_95, 0) << "no counts";
}

TEST(MeanWithInterval, OneValueHasNoIntervalAndNoneHasNoMean) {
  EXPECT_DOUBLE_EQ(mean_with_interval({7}).mean, 7);
  EXPECT_FALSE(mean_with_interval({7}).half_width_95);
  EXPECT_TRUE(std::isnan(mean_with_interval({}).mean));
}

TEST(MeanWithInterval, KeepsDigitsFarFromZero) {
  EXPECT_NEAR(*mean_with_interval({1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 4, 1e9 + 5}).half_width_95, 1.963243, 1e-6);
}

TEST(CoefficientOfVariation, IsSampleDeviationOverMean) {
  EXPECT_NEAR(*coefficient_of_variation({1, 2, 3, 4, 5}), 1.581139 / 3, 1e-6);
  EXPECT_DOUBLE_EQ(*coefficient_of_variation({4, 4, 4}), 0);
  EXPECT_FALSE(coefficient_of_variation({4}));
  EXPECT_FALSE(coefficient_of_variation({0, 0}));
}

}  // namespace
}  // namespace vibrosow
