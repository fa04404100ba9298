#include "selection/rinott.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "selection/made_up_systems.hpp"

namespace vibrosow {
namespace {

/// The integral by chance: how often the best is found when its mean is the least by the margin.
double found_by_chance(std::size_t systems, int first, double h, int tries) {
  MadeUpChance chance(7);
  const auto scaled = [&] {  // degrees of freedom over chi squared
    double squares = 0;
    for (int i = 1; i < first; ++i) squares += std::pow(chance.normal(), 2);
    return (first - 1) / squares;
  };
  double found = 0;
  for (int i = 0; i < tries; ++i) {
    const double ours = scaled();
    double all = 1;
    for (std::size_t k = 1; k < systems; ++k) all *= cdf(boost::math::normal(), h / std::sqrt(ours + scaled()));
    found += all / tries;
  }
  return found;
}

TEST(Rinott, ConstantSolvesItsIntegral) {
  for (const std::size_t systems : {2u, 10u, 60u})
    EXPECT_NEAR(found_by_chance(systems, 10, rinott_h(systems, 10, 0.95), 4000), 0.95, 0.01) << systems;
}

TEST(Rinott, ConstantGrowsWithSystemsAndFallsWithFirstObservations) {
  EXPECT_GT(rinott_h(20, 10, 0.95), rinott_h(10, 10, 0.95));
  EXPECT_GT(rinott_h(10, 10, 0.99), rinott_h(10, 10, 0.95));
  EXPECT_LT(rinott_h(10, 20, 0.95), rinott_h(10, 10, 0.95));
  // Without end: known variances, two systems: sqrt(2) z(0.95).
  EXPECT_NEAR(rinott_h(2, 5001, 0.95), std::sqrt(2.0) * 1.644854, 0.002);
}

TEST(Rinott, ConstantOfTwoByTwoObservationsIsCauchys) {
  // Each mean is known by one degree of freedom: the difference of two Cauchy numbers is one twice as wide.
  EXPECT_NEAR(rinott_h(2, 2, 0.95), 2 * std::tan(0.45 * std::numbers::pi), 0.01);
}

TEST(Rinott, ConstantOfKnownVariancesIsThatOfIndependentPairs) {
  for (const std::size_t systems : {3U, 10U, 60U}) {
    const double of_pair = std::pow(0.95, 1 / (static_cast<double>(systems) - 1));
    EXPECT_NEAR(rinott_h(systems, 20001, 0.95), std::sqrt(2.0) * quantile(boost::math::normal(), of_pair), 0.002)
        << systems;
  }
}

TEST(Rinott, Observations) {
  EXPECT_EQ(rinott_observations(3, 4, 1, 10), 36);
  EXPECT_EQ(rinott_observations(3, 0.01, 1, 10), 10);
}

TEST(Rinott, RefusesWhatCannotBeMeant) {
  EXPECT_THROW(rinott_h(1, 10, 0.95), std::invalid_argument);
  EXPECT_THROW(rinott_h(2, 1, 0.95), std::invalid_argument);
  EXPECT_THROW(rinott_h(2, 10, 1), std::invalid_argument);
  EXPECT_THROW(rinott_h(4, 10, 0.25), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
