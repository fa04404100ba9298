#include "outflow/misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace vibrosow {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

TEST(RateMisfit, IsTheRelativeRms) {
  // errors +10 % and -20 %
  EXPECT_NEAR(*rate_misfit_percent({1.1, 8}, {1, 10}), 100 * std::sqrt((0.01 + 0.04) / 2), 1e-9);
  EXPECT_NEAR(*rate_misfit_percent({2, 20}, {1, 10}, 0.5), 0, 1e-12);
}

TEST(RateMisfit, BestScaleIsTheLeast) {
  const std::vector<double> simulated = {2.2, 16}, measured = {1, 10};
  const double scale = *best_rate_scale(simulated, measured);
  EXPECT_NEAR(scale, (2.2 + 1.6) / (2.2 * 2.2 + 1.6 * 1.6), 1e-12);
  const double least = *rate_misfit_percent(simulated, measured, scale);
  EXPECT_LT(least, *rate_misfit_percent(simulated, measured, scale * 1.01));
  EXPECT_LT(least, *rate_misfit_percent(simulated, measured, scale * 0.99));
}

TEST(CurveMisfit, IsTheRmsOverTheLargestMeasured) {
  EXPECT_NEAR(*curve_misfit_percent({1, 2, 7}, {0, 4, 8}), 100 * std::sqrt((1 + 4 + 1) / 3.0) / 8, 1e-9);
}

TEST(CurveMisfit, BestScaleIsTheLeast) {
  const std::vector<double> simulated = {1, 2, 7}, measured = {0, 4, 8};
  const double scale = *best_curve_scale(simulated, measured);
  EXPECT_NEAR(scale, 64.0 / 54, 1e-12);
  const double least = *curve_misfit_percent(simulated, measured, scale);
  EXPECT_LT(least, *curve_misfit_percent(simulated, measured, scale * 1.01));
  EXPECT_LT(least, *curve_misfit_percent(simulated, measured, scale * 0.99));
}

TEST(Misfit, IsEmptyWhereUndefined) {
  EXPECT_FALSE(rate_misfit_percent({}, {}));
  EXPECT_FALSE(rate_misfit_percent({1}, {0}));
  EXPECT_FALSE(rate_misfit_percent({undefined}, {1}));
  EXPECT_FALSE(best_rate_scale({0}, {1}));
  EXPECT_FALSE(curve_misfit_percent({1, 1}, {0, 0}));
  EXPECT_FALSE(curve_misfit_percent({1, undefined}, {0, 1}));
  EXPECT_FALSE(best_curve_scale({0, 0}, {0, 1}));
  EXPECT_THROW(rate_misfit_percent({1, 2}, {1}), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
