#include "surrogate/posterior_sample.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "surrogate/hypercube.hpp"
#include "surrogate/sobol_points.hpp"

namespace vibrosow {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A surrogate of a + b.x, which it knows all but exactly.
GaussianProcess plane(double a, const Eigen::Vector2d& b) {
  const MatrixXd points = hypercube(12, 2, 5);
  return {points, ((points * b).array() + a).matrix()};
}

TEST(PosteriorSample, OfLinearFunctionsWithNormalNoiseIsTheClosedForm) {
  MatrixXd slopes(3, 2);
  slopes << 1, 0.5, -0.3, 1, 0.4, 0.4;
  const VectorXd noise = VectorXd::Constant(3, 0.03);
  const Eigen::Vector2d where(0.45, 0.55);
  std::vector<GaussianProcess> surrogates;
  std::vector<ObservedValues> observed;
  for (int k = 0; k < 3; ++k) surrogates.push_back(plane(k, slopes.row(k).transpose()));
  for (int k = 0; k < 3; ++k)
    observed.push_back({{&surrogates[static_cast<std::size_t>(k)]},
                        VectorXd::Constant(1, k + slopes.row(k).dot(where)),
                        MatrixXd::Constant(1, 1, noise(k) * noise(k))});
  const PosteriorSample known = posterior_sample(observed, 2);
  const MatrixXd precision = slopes.transpose() * (1 / noise.array().square()).matrix().asDiagonal() * slopes;
  const MatrixXd covariance = precision.inverse();
  for (int d = 0; d < 2; ++d) {
    const double deviation = std::sqrt(covariance(d, d));
    EXPECT_NEAR(weighted_mean(known.points.col(d), known.weights), where(d), 0.02 * deviation);
    EXPECT_NEAR(weighted_deviation(known.points.col(d), known.weights), deviation, 0.02 * deviation);
    EXPECT_NEAR(weighted_quantile(known.points.col(d), known.weights, 0.975), where(d) + 1.96 * deviation,
                0.03 * deviation);
  }
  EXPECT_NEAR(weighted_correlation(known.points.col(0), known.points.col(1), known.weights),
              covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)), 0.02);
  EXPECT_GT(known.effective_points, 1000);
  EXPECT_LT(known.least_misfit, 0.01);
}

/// Values that share their chance count as fewer: two of correlation 0.9 say nearly the same.
TEST(PosteriorSample, KnowsOfSharedChance) {
  const GaussianProcess surrogate = plane(0, {1, 0});
  MatrixXd chance(2, 2);
  chance << 1, 0.9, 0.9, 1;
  chance *= 0.02 * 0.02;
  const PosteriorSample known = posterior_sample({{{&surrogate, &surrogate}, VectorXd::Constant(2, 0.5), chance}}, 2);
  EXPECT_NEAR(weighted_deviation(known.points.col(0), known.weights), 0.02 * std::sqrt(0.95), 0.0004);
  EXPECT_NEAR(weighted_deviation(known.points.col(1), known.weights), std::sqrt(1 / 12.0), 0.003);  // as before
}

/// With an unknown shift only differences count: of x + s and -x + s the first less the second is 2 x.
TEST(PosteriorSample, IntegratesOverAShift) {
  const GaussianProcess up = plane(0, {1, 0}), down = plane(0, {-1, 0});
  const MatrixXd chance = MatrixXd::Constant(1, 1, 0.04 * 0.04);
  const PosteriorSample known = posterior_sample(
      {{{&up}, VectorXd::Constant(1, 7.5), chance, true}, {{&down}, VectorXd::Constant(1, 6.5), chance, true}}, 2);
  EXPECT_NEAR(weighted_mean(known.points.col(0), known.weights), 0.5, 0.001);
  EXPECT_NEAR(weighted_deviation(known.points.col(0), known.weights), 0.04 / std::sqrt(2.0), 0.001);
  EXPECT_NEAR(weighted_mean(known.shifts, known.weights), 7, 0.001);
  EXPECT_NEAR(weighted_deviation(known.shifts, known.weights), 0.04 / std::sqrt(2.0), 0.001);
}

/// What a surrogate does not know of itself widens what is known by it.
TEST(PosteriorSample, HoldsTheSurrogatesOwnError) {
  const MatrixXd points = hypercube(12, 1, 5);
  VectorXd values = points.col(0);
  for (Eigen::Index i = 0; i < 12; ++i) values(i) += 0.02 * static_cast<double>((7 * i) % 5 - 2);
  const GaussianProcess surrogate(points, values);
  const double middle = surrogate.at(MatrixXd::Constant(1, 1, 0.5)).mean(0);
  const PosteriorSample known =
      posterior_sample({{{&surrogate}, VectorXd::Constant(1, middle), MatrixXd::Constant(1, 1, 1e-6)}}, 1);
  const GaussianPrediction fit = surrogate.at(known.points);
  const double own = weighted_mean(fit.variance, known.weights);
  ASSERT_GT(own, 1e-5);
  EXPECT_NEAR(weighted_deviation(fit.mean, known.weights), std::sqrt(own + 1e-6), 0.1 * std::sqrt(own));
}

/// Where a surrogate knows less, a value that fits is less likely: the density of a wide normal is low in its middle.
TEST(PosteriorSample, WeighsPointsByTheDensityOfTheValueThere) {
  const MatrixXd points = 0.4 * hypercube(12, 1, 5);  // nothing is known beyond
  const GaussianProcess surrogate(points, (8 * points.array()).sin().matrix());
  const double value = 0.5, chance = 0.2 * 0.2;
  const PosteriorSample known =
      posterior_sample({{{&surrogate}, VectorXd::Constant(1, value), MatrixXd::Constant(1, 1, chance)}}, 1);
  const GaussianPrediction fit = surrogate.at(known.points);
  const VectorXd variance = fit.variance.array() + chance;
  ASSERT_GT(variance.maxCoeff(), 4 * variance.minCoeff());
  VectorXd density = (-0.5 * (fit.mean.array() - value).square() / variance.array()).exp() / variance.array().sqrt();
  density /= density.sum();
  EXPECT_LT((known.weights - density).cwiseAbs().maxCoeff(), 1e-9 * density.maxCoeff());
}

TEST(PosteriorSample, SaysWhereNoPointFits) {
  const GaussianProcess surrogate = plane(0, {1, 0});
  const MatrixXd chance = MatrixXd::Constant(1, 1, 0.01);
  EXPECT_NEAR(posterior_sample({{{&surrogate}, VectorXd::Constant(1, 2), chance}}, 2).least_misfit, 100, 1);
}

TEST(PosteriorSample, NeedsAValue) {
  EXPECT_THROW(posterior_sample({}, 2), std::invalid_argument);
}

TEST(PointsOfEqualWeight, TakesHeavyPointsOften) {
  const VectorXd weights = (VectorXd(4) << 0.5, 0, 0.25, 0.25).finished();
  EXPECT_EQ(points_of_equal_weight(weights, 4), (std::vector<Eigen::Index>{0, 0, 2, 3}));
}

/// Of Sobol's points, which fill boxes of a half, a quarter, .. in turn, as many are taken everywhere as their weights
/// say.
TEST(PointsOfEqualWeight, LieAsTheWeightsDoThoughThePointsHaveAPattern) {
  for (const Eigen::Index all : {1024, 4096, 16384})
    for (const double deviation : {0.05, 0.08, 0.15}) {
      const VectorXd places = sobol_points(all, 1).col(0);
      VectorXd weights = (-0.5 * ((places.array() - 0.5) / deviation).square()).exp();
      weights /= weights.sum();
      const std::vector<Eigen::Index> taken = points_of_equal_weight(weights, 512);
      const VectorXd at = places(taken);
      EXPECT_NEAR(at.mean(), 0.5, 0.15 * deviation) << all << ' ' << deviation;
      EXPECT_NEAR(std::sqrt((at.array() - at.mean()).square().mean()), weighted_deviation(places, weights),
                  0.12 * deviation)
          << all << ' ' << deviation;
    }
}

TEST(WeightedQuantile, LiesBetweenValuesByTheirWeights) {
  const VectorXd values = (VectorXd(4) << 4, 1, 3, 2).finished(), weights = VectorXd::Constant(4, 0.25);
  EXPECT_DOUBLE_EQ(weighted_quantile(values, weights, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(weighted_quantile(values, weights, 0), 1);
  EXPECT_DOUBLE_EQ(weighted_quantile(values, weights, 1), 4);
}

TEST(WeightedDeviation, IsThatOfTheWeights) {
  const VectorXd values = (VectorXd(3) << 1, 2, 5).finished(), weights = (VectorXd(3) << 0.5, 0.25, 0.25).finished();
  EXPECT_DOUBLE_EQ(weighted_mean(values, weights), 2.25);
  EXPECT_DOUBLE_EQ(weighted_deviation(values, weights), std::sqrt(0.5 * 1.5625 + 0.25 * 0.0625 + 0.25 * 7.5625));
}

}  // namespace
}  // namespace vibrosow
