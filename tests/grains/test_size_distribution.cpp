// Draws of a fixed seed against the distribution: moments within bounds of the sampling error, and Kolmogorov's
// distance.
#include "grains/size_distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "scene/seed_lot.hpp"

namespace vibrosow::size_distribution_test {
namespace {

using Kind = SizeDistribution::Kind;

constexpr double diameter = 4e-3;
constexpr int draws = 100000;

SeedLot lot_with(const SizeDistribution& sizes, Shape shape = Shape::ball) {
  SeedLot lot{"a", diameter, 4e-5, shape, 1.0};
  lot.sizes = sizes;
  return lot;
}

std::vector<double> drawn(const SeedLot& lot) {
  Random random(11);
  std::vector<double> sizes;
  for (int k = 0; k < draws; ++k) sizes.push_back(draw_size(lot, random));
  return sizes;
}

/// `cumulative` is the distribution of the diameter, m. Four standard errors; Kolmogorov's 0.1 % point.
void expect_distribution(const SeedLot& lot, const std::function<double(double)>& cumulative) {
  std::vector<double> sizes = drawn(lot);
  std::sort(sizes.begin(), sizes.end());
  EXPECT_GE(sizes.front(), least_size(lot));
  EXPECT_LE(sizes.back(), most_size(lot));
  double mean = 0, square = 0, distance = 0;
  for (int k = 0; k < draws; ++k) {
    const double size = sizes[static_cast<std::size_t>(k)], below = cumulative(size * diameter);
    mean += size / draws;
    square += size * size / draws;
    distance = std::max({distance, std::abs(below - static_cast<double>(k) / draws),
                         std::abs(below - static_cast<double>(k + 1) / draws)});
  }
  EXPECT_LT(distance, 1.95 / std::sqrt(draws));
  const double m1 = size_moment(lot, 1), variance = size_moment(lot, 2) - m1 * m1;
  EXPECT_NEAR(mean, m1, 4 * std::sqrt(variance / draws));
  // A square's own variance, with the distribution's width bounding its fourth moment.
  const double widest = std::max(std::abs(most_size(lot) - 1), std::abs(1 - least_size(lot)));
  EXPECT_NEAR(square - mean * mean, variance, 4 * widest * std::sqrt(variance / draws));
}

TEST(DrawSize, SingleSizeDrawsNothing) {
  Random random(1), untouched(1);
  const SeedLot lot = lot_with({});
  EXPECT_EQ(draw_size(lot, random), 1.0);
  EXPECT_EQ(draw_angle(lot, random), 0.0);
  EXPECT_EQ(random.uniform(), untouched.uniform());
}

TEST(DrawSize, Uniform) {
  expect_distribution(lot_with({Kind::uniform, diameter, 0, 3e-3, 5e-3, {}, {}}),
                      [](double d) { return (d - 3e-3) / 2e-3; });
}

TEST(DrawSize, NormalCutUnevenly) {
  const boost::math::normal whole(4e-3, 1e-3);
  const double low = cdf(whole, 3.5e-3), high = cdf(whole, 7e-3);
  expect_distribution(lot_with({Kind::normal, diameter, 1e-3, 3.5e-3, 7e-3, {}, {}}),
                      [=](double d) { return (cdf(whole, d) - low) / (high - low); });
}

TEST(DrawSize, LognormalOfGivenMeanAndDeviation) {
  const double variance = std::log(1 + 0.25 * 0.25);
  const boost::math::lognormal whole(std::log(4e-3) - variance / 2, std::sqrt(variance));
  const double low = cdf(whole, 2e-3), high = cdf(whole, 9e-3);
  expect_distribution(lot_with({Kind::lognormal, diameter, 1e-3, 2e-3, 9e-3, {}, {}}),
                      [=](double d) { return (cdf(whole, d) - low) / (high - low); });
}

TEST(DrawSize, TableComesInItsShares) {
  const SeedLot lot = lot_with({Kind::table, diameter, 0, 0, 0, {3e-3, 4e-3, 6e-3}, {0.3, 0.6, 0.1}});
  int counts[3] = {};
  for (const double size : drawn(lot)) {
    const double d = size * diameter;
    ++counts[d < 3.5e-3 ? 0 : d < 5e-3 ? 1 : 2];
    EXPECT_TRUE(d == 3e-3 || d == 4e-3 || d == 6e-3) << d;
  }
  for (int k = 0; k < 3; ++k) {
    const double fraction = lot.sizes.fraction[static_cast<std::size_t>(k)];
    EXPECT_NEAR(counts[k], draws * fraction, 4 * std::sqrt(draws * fraction * (1 - fraction)));
  }
}

TEST(DrawSize, CutFarWiderThanTheDistributionStillDraws) {
  const SeedLot lot = lot_with({Kind::normal, diameter, 1e-8, 1e-3, 9e-3, {}, {}});
  for (const double size : drawn(lot)) ASSERT_NEAR(size, 1, 2e-5);
}

TEST(DrawAngle, OfClumpsIsUniformOverAllTurns) {
  const SeedLot clump = lot_with({}, Shape::clump);
  Random random(3);
  double cosine = 0, sine = 0, least = 10, most = 0;
  for (int k = 0; k < draws; ++k) {
    const double angle = draw_angle(clump, random);
    cosine += std::cos(angle) / draws, sine += std::sin(angle) / draws;
    least = std::min(least, angle), most = std::max(most, angle);
  }
  EXPECT_NEAR(cosine, 0, 4 * std::sqrt(0.5 / draws));
  EXPECT_NEAR(sine, 0, 4 * std::sqrt(0.5 / draws));
  EXPECT_GE(least, 0);
  EXPECT_LT(least, 0.001);
  EXPECT_LT(most, 2 * std::numbers::pi);
  EXPECT_GT(most, 2 * std::numbers::pi - 0.001);
}

TEST(DrawnOrientations, PreferNoWay) {
  // The mean of each direction cosine is 0, that of its square 1/3: of 20 000 to 0.004 and 0.002.
  constexpr int ways = 20000;
  Random random(7);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), sum_of_squares = sum;
  for (int k = 0; k < ways; ++k) {
    const Eigen::Matrix3d axes = rotation_matrix(draw_orientation(random));
    sum += axes, sum_of_squares += axes.cwiseAbs2();
  }
  EXPECT_LT((sum / ways).cwiseAbs().maxCoeff(), 0.016);
  EXPECT_LT((sum_of_squares.array() / ways - 1.0 / 3).abs().maxCoeff(), 0.009);
}

}  // namespace
}  // namespace vibrosow::size_distribution_test
