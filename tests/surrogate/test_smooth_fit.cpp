#include "surrogate/smooth_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "selection/made_up_systems.hpp"

namespace vibrosow {
namespace {

TEST(SmoothFit, GoesThroughWhatWasSeen) {
  const auto truth = [](double x, double y) { return 3 + std::sin(3 * x) + 0.5 * y; };
  std::vector<SeenValue> seen;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) seen.push_back({{i / 5.0, j / 3.0}, truth(i / 5.0, j / 3.0), 1e-6});
  SmoothFit fit(2);
  fit.fit(seen);
  for (const double x : {0.1, 0.33, 0.77})
    for (const double y : {0.15, 0.6}) {
      const SmoothFit::Prediction here = fit.at({x, y});
      EXPECT_NEAR(here.mean, truth(x, y), 0.02);
      EXPECT_LT(here.deviation, 0.05);
    }
  EXPECT_GT(fit.at({3, 3}).deviation, 0.2);
  EXPECT_THROW(fit.fit({{{0, 0}, 1, 0}}), std::invalid_argument);
}

TEST(SmoothFit, SmoothsWhatIsNoisy) {
  MadeUpChance chance(5);
  std::vector<SeenValue> seen;
  for (int i = 0; i < 60; ++i) seen.push_back({{i / 59.0}, 1 + 0.3 * chance.normal(), 0.09});
  SmoothFit fit(1);
  fit.fit(seen);
  EXPECT_NEAR(fit.at({0.5}).mean, 1, 0.2);
}

/// Values so far apart that none says anything of another: each is known by its own error and the spread of all.
TEST(SmoothFit, WeighsEachValueByItsError) {
  const std::vector<double> values = {-3, -1, 0, 1, 3}, errors = {0.5, 1, 0, 1.5, 0.7};
  std::vector<SeenValue> seen;
  for (std::size_t i = 0; i < values.size(); ++i)
    seen.push_back({{1e5 * static_cast<double>(i)}, values[i], errors[i] * errors[i]});
  SmoothFit fit(1);
  fit.fit(seen);
  constexpr double spread = 20.0 / 4;  // variance of the values, n - 1
  // Of the variances that it tries, the likeliest.
  const auto likelihood = [&](double variance) {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double of_one = variance + errors[i] * errors[i] + 1e-6 * spread;
      sum -= 0.5 * (values[i] * values[i] / of_one + std::log(of_one));
    }
    return sum;
  };
  double variance = 0;
  for (const double scale : {0.3, 1.0, 3.0, 10.0, 30.0})
    if (variance == 0 || likelihood(scale * spread) > likelihood(variance)) variance = scale * spread;
  const SmoothFit::Prediction away = fit.at({-1e7});
  EXPECT_NEAR(away.mean, 0, 1e-12);
  EXPECT_NEAR(away.deviation, std::sqrt(variance), 1e-9);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error2 = errors[i] * errors[i] + 1e-6 * spread;
    const SmoothFit::Prediction here = fit.at(seen[i].place);
    EXPECT_NEAR(here.mean, values[i] * variance / (variance + error2), 1e-9) << i;
    EXPECT_NEAR(here.deviation, std::sqrt(variance * error2 / (variance + error2)), 1e-7) << i;
  }
}

}  // namespace
}  // namespace vibrosow
