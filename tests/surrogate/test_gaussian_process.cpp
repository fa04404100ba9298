#include "surrogate/gaussian_process.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "grains/random.hpp"
#include "surrogate/hypercube.hpp"
#include "surrogate/sobol_points.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double truth(const VectorXd& x) {
  return std::sin(4 * x(0)) + x(1) * x(1);
}

struct Sample {
  MatrixXd points;
  VectorXd values;
};

/// The true function with normal noise, at points of which none matters along the last dimension.
Sample sample(Index count, double noise, std::uint64_t random_seed = 1) {
  Random random(random_seed);
  Sample made{hypercube(count, 3, random_seed), VectorXd(count)};
  const boost::math::normal normal;
  for (Index i = 0; i < count; ++i)
    made.values(i) =
        truth(made.points.row(i).transpose()) + noise * quantile(normal, 0.5e-9 + (1 - 1e-9) * random.uniform());
  return made;
}

TEST(GaussianProcess, MeetsASmoothFunctionBetweenItsPoints) {
  const Sample made = sample(60, 0);
  const GaussianProcess process(made.points, made.values);
  const MatrixXd elsewhere = sobol_points(200, 3);
  const GaussianPrediction prediction = process.at(elsewhere);
  double squares = 0;
  for (Index i = 0; i < elsewhere.rows(); ++i)
    squares += std::pow(prediction.mean(i) - truth(elsewhere.row(i).transpose()), 2);
  EXPECT_LT(std::sqrt(squares / 200), 0.01);  // of a function that goes from -1 to 2
  EXPECT_GT(process.covariance().lengths(2), 3 * process.covariance().lengths(0));  // nothing happens along it
}

TEST(GaussianProcess, FindsTheNoiseAndKnowsHowFarItErrs) {
  const double noise = 0.2;
  const Sample made = sample(150, noise);
  const GaussianProcess process(made.points, made.values);
  EXPECT_NEAR(std::sqrt(process.noise()), noise, 0.04);
  const MatrixXd elsewhere = sobol_points(500, 3);
  const GaussianPrediction prediction = process.at(elsewhere);
  double normalised = 0;
  for (Index i = 0; i < elsewhere.rows(); ++i)
    normalised += std::pow(prediction.mean(i) - truth(elsewhere.row(i).transpose()), 2) / prediction.variance(i);
  EXPECT_GT(normalised / 500, 0.3);
  EXPECT_LT(normalised / 500, 2.0);
  EXPECT_NEAR(std::sqrt(process.left_out_errors().squaredNorm() / 150), 1, 0.15);
}

TEST(Kriging, LeavesOutAValueAsIfItHadNotBeenThere) {
  const Sample made = sample(20, 0.1);
  const GaussianProcess all(made.points, made.values);
  const Kriging others(made.points.bottomRows(19), made.values.tail(19), all.covariance());
  const GaussianPrediction prediction = others.at(made.points.topRows(1));
  const double deviation = std::sqrt(prediction.variance(0) + all.covariance().noise);
  EXPECT_NEAR(all.left_out_errors()(0), (made.values(0) - prediction.mean(0)) / deviation, 1e-6);
}

/// Universal kriging as textbooks write it: with the trend's coefficients among the unknowns.
TEST(Kriging, IsTheTextbooks) {
  const Sample made = sample(12, 0.1);
  const Covariance covariance{VectorXd::Constant(3, 0.7), 1.3, 0.02};
  const Kriging process(made.points, made.values, covariance);
  const auto matern = [&](const VectorXd& a, const VectorXd& b) {
    const double r = std::sqrt(5.0) * (a - b).norm() / 0.7;
    return 1.3 * (1 + r + r * r / 3) * std::exp(-r);
  };
  MatrixXd system = MatrixXd::Zero(16, 16);
  VectorXd right(16);
  const VectorXd at = VectorXd::Constant(3, 0.4);
  for (Index i = 0; i < 12; ++i) {
    for (Index j = 0; j < 12; ++j) system(i, j) = matern(made.points.row(i), made.points.row(j)) + (i == j ? 0.02 : 0);
    system(i, 12) = system(12, i) = 1;
    for (Index d = 0; d < 3; ++d) system(i, 13 + d) = system(13 + d, i) = made.points(i, d);
    right(i) = matern(made.points.row(i), at);
  }
  right(12) = 1;
  right.tail(3) = at;
  const VectorXd weights = system.inverse() * right;
  const GaussianPrediction prediction = process.at(at.transpose());
  EXPECT_NEAR(prediction.mean(0), weights.head(12).dot(made.values), 1e-9);
  EXPECT_NEAR(prediction.variance(0), 1.3 - weights.dot(right), 1e-9);
}

/// How many of the true values lie within 95 % intervals.
int within(const GaussianPrediction& prediction, const MatrixXd& points) {
  int count = 0;
  for (Index i = 0; i < points.rows(); ++i)
    if (std::abs(prediction.mean(i) - truth(points.row(i).transpose())) < 1.96 * std::sqrt(prediction.variance(i)))
      ++count;
  return count;
}

/// With few values the covariance itself is uncertain, and the prediction's variance knows of it.
TEST(GaussianProcess, KnowsHowFarItErrsFromFewValuesToo) {
  int of_all = 0, of_the_likeliest = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Sample made = sample(20, 0.1, seed);
    const GaussianProcess process(made.points, made.values);
    const MatrixXd elsewhere = sobol_points(50, 3);
    of_all += within(process.at(elsewhere), elsewhere);
    of_the_likeliest += within(Kriging(made.points, made.values, process.covariance()).at(elsewhere), elsewhere);
  }
  EXPECT_GT(of_all, 860);  // of 1000; 950 would be right
  EXPECT_GT(of_all, of_the_likeliest + 20);
}

/// A value that stands alone may be chance or not, and covariances disagree about it. Each by itself is at its place at
/// least as sure as the value is, whose variance is the noise; where they disagree, all together are less so.
TEST(GaussianProcess, DoubtsAValueOfWhichItsCovariancesDisagree) {
  constexpr Index count = 16;
  MatrixXd points(count, 1);
  VectorXd values(count);
  for (Index i = 0; i < count; ++i) {
    points(i, 0) = (static_cast<double>(i) + 0.5) / count;
    values(i) = i == 0 ? 1 : i % 2 == 0 ? 0.02 : -0.02;
  }
  const GaussianProcess process(points, values);
  const Kriging likeliest(points, values, process.covariance());
  EXPECT_LT(likeliest.at(points.topRows(1)).variance(0), process.covariance().noise);
  EXPECT_GT(process.at(points.topRows(1)).variance(0), 1.3 * process.noise());
}

TEST(GaussianProcess, TakesAPlaneForAPlane) {
  const MatrixXd points = hypercube(15, 2, 1);
  const VectorXd values = 3 + 2 * points.col(0).array() - points.col(1).array();
  const GaussianPrediction prediction = GaussianProcess(points, values).at(MatrixXd::Constant(1, 2, 0.9));
  EXPECT_NEAR(prediction.mean(0), 3.9, 1e-6);
  EXPECT_LT(prediction.variance(0), 1e-6);
}

TEST(GaussianProcess, TakesValuesThatAreAllTheSame) {
  const GaussianPrediction prediction =
      GaussianProcess(hypercube(10, 2, 1), VectorXd::Constant(10, 5)).at(MatrixXd::Constant(1, 2, 0.5));
  EXPECT_NEAR(prediction.mean(0), 5, 1e-9);
}

/// A function that one covariance alone explains: values that go up and down, which are noise whatever its length.
/// Their variance's scale is integrated out, so the residuals' squares count over two degrees of freedom fewer than
/// they have.
TEST(GaussianProcess, TakesTheMeanOfAVarianceThatItDoesNotKnow) {
  constexpr Index count = 12;
  MatrixXd points(count, 1), trend(count, 2);
  VectorXd values(count);
  for (Index i = 0; i < count; ++i) {
    points(i, 0) = (static_cast<double>(i) + 0.5) / count;
    trend.row(i) << 1, points(i, 0);
    values(i) = 3 + 2 * points(i, 0) + (i % 2 == 0 ? 0.1 : -0.1);
  }
  const MatrixXd normal = trend.transpose() * trend;
  const VectorXd residuals = values - trend * (normal.inverse() * (trend.transpose() * values));
  const double expected = residuals.squaredNorm() / (count - 2 - 2);
  const GaussianProcess process(points, values);
  EXPECT_NEAR(process.covariance().signal + process.covariance().noise, expected, 0.02 * expected);
  EXPECT_NEAR(process.noise(), expected, 0.1 * expected);
}

TEST(GaussianProcess, RefusesTooFewValuesAndSuchAsAreNone) {
  EXPECT_THROW(GaussianProcess(hypercube(5, 2, 1), VectorXd::Zero(5)), std::invalid_argument);
  VectorXd values = VectorXd::Zero(9);
  values(3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(GaussianProcess(hypercube(9, 2, 1), values), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
