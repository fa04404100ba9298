#include "agronomy/spacings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace vibrosow {
namespace {

TEST(Spacings, SeedsLikeClockworkAreAllSingles) {
  const auto spacings = spacings_of({1.0, 1.1, 1.2, 1.3}, 2.0);
  ASSERT_EQ(spacings.size(), 3u);
  const auto metrics = spacing_metrics(spacings);
  ASSERT_TRUE(metrics);
  EXPECT_NEAR(metrics->mean, 0.2, 1e-12);
  EXPECT_NEAR(metrics->reference, 0.2, 1e-12);
  EXPECT_EQ(metrics->multiples, 0);
  EXPECT_EQ(metrics->skips, 0);
  EXPECT_EQ(metrics->singles, 1);
  EXPECT_NEAR(*metrics->precision, 0, 1e-12);
  EXPECT_NEAR(metrics->deviation, 0, 1e-12);
}

TEST(Spacings, AreCountedAgainstTheReference) {
  // Beside 100 mm: 40 and 50 are multiples, 80 and 120 singles, 150 not yet a skip, 160 one.
  std::vector<Spacing> spacings;
  for (const double length : {0.04, 0.05, 0.08, 0.12, 0.15, 0.16}) spacings.push_back({length, 0.1});
  const auto metrics = spacing_metrics(spacings);
  EXPECT_EQ(metrics->spacings, 6);
  EXPECT_NEAR(metrics->multiples, 2.0 / 6, 1e-12);
  EXPECT_NEAR(metrics->skips, 1.0 / 6, 1e-12);
  EXPECT_NEAR(metrics->singles, 3.0 / 6, 1e-12);
  EXPECT_NEAR(metrics->mean, 0.1, 1e-12);
  EXPECT_NEAR(metrics->deviation, (0.06 + 0.05 + 0.02 + 0.02 + 0.05 + 0.06) / 6, 1e-12);
  // Of 0.8, 1.2 and 1.5: mean 7/6, squares about it (11^2 + 1 + 10^2) / 900, over 2.
  EXPECT_NEAR(*metrics->precision, std::sqrt(222.0 / 900 / 2), 1e-12);
  EXPECT_NEAR(*metrics->cv, std::sqrt((0.36 + 0.25 + 0.04 + 0.04 + 0.25 + 0.36) / 5), 1e-12);
}

TEST(Spacings, ASkipLeavesTheOthersSingles) {
  // A seed left out of a regular row: one spacing of two references.
  const auto metrics = spacing_metrics(spacings_of({0, 1, 2, 4, 5}, 0.1, 0.1));
  EXPECT_DOUBLE_EQ(metrics->skips, 0.25);
  EXPECT_EQ(metrics->multiples, 0);
}

TEST(Spacings, APoissonStreamHasItsMultiplesAndSkips) {
  constexpr int seeds = 100000;
  std::mt19937_64 generator(7);
  std::vector<double> times = {0};
  for (int i = 0; i < seeds; ++i) {
    const double uniform = (static_cast<double>(generator() >> 11) + 0.5) / 9007199254740992.0;
    times.push_back(times.back() - std::log(uniform) / 40);
  }
  const auto metrics = spacing_metrics(spacings_of(times, 2.2));
  const auto error = [](double part) { return 3 * std::sqrt(part * (1 - part) / seeds); };
  EXPECT_NEAR(poisson_multiples(), 0.3935, 1e-4);
  EXPECT_NEAR(poisson_skips(), 0.2231, 1e-4);
  EXPECT_NEAR(metrics->multiples, poisson_multiples(), error(0.39));
  EXPECT_NEAR(metrics->skips, poisson_skips(), error(0.22));
  EXPECT_NEAR(metrics->mean, 2.2 / 40, 3 * 2.2 / 40 / std::sqrt(seeds));
  EXPECT_NEAR(*metrics->cv, 1, 0.02);
  // Beside a reference of half the mean it is another share.
  const auto half = spacing_metrics(spacings_of(times, 2.2, 1.1 / 40));
  EXPECT_NEAR(half->multiples, poisson_multiples({}, 0.5), error(0.22));
  EXPECT_NEAR(half->skips, poisson_skips({}, 0.5), error(0.47));
}

TEST(Spacings, NeedTwoSeedsThatDoNotComeAtOnce) {
  EXPECT_TRUE(spacings_of({}, 2).empty());
  EXPECT_TRUE(spacings_of({1}, 2).empty());
  EXPECT_TRUE(spacings_of({1, 1}, 2).empty());
  EXPECT_FALSE(spacing_metrics({}));
  EXPECT_FALSE(spacing_metrics({{0.1, 0.1}})->precision);  // of one there is no deviation
  EXPECT_THROW(spacing_metrics({{0.1, 0}}), std::invalid_argument);
  EXPECT_THROW(spacing_metrics({{0.1, 0.1}}, {.multiples_below = 1.5, .skips_above = 0.5}), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
