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

}  // namespace
}  // namespace vibrosow
