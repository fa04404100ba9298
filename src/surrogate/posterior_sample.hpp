#pragma once

#include <Eigen/Core>
#include <vector>

#include "surrogate/gaussian_process.hpp"

namespace vibrosow {

/// Values that were measured together, and what says what each would be at a point.
struct ObservedValues {
  std::vector<const GaussianProcess*> surrogates;  // one for each value
  Eigen::VectorXd values;
  Eigen::MatrixXd chance;  // covariance of the values' own chance
  /// The values lie above what the surrogates say by an unknown amount, the same for all that are so.
  bool shifted = false;
};

/// What is known of a point after its values were observed: points with weights. The prior is flat in the unit cube,
/// and flat for the shift. An interval of a weighted sum of points means the equal-tailed one.
struct PosteriorSample {
  Eigen::MatrixXd points;       // one a row
  Eigen::VectorXd weights;      // their sum is 1
  Eigen::VectorXd shifts;       // of each point; empty where no value is shifted
  double effective_points = 0;  // 1 / sum of the squares of the weights
  double least_misfit = 0;      // chi squared of the values at the point that fits best
};

/// By importance sampling on Sobol's points, so that it is the same on every machine but for last digits: weights are
/// the values' likelihood, in which the surrogates' own uncertainty counts, and over the shift the integral. Points
/// that weigh little make way: the box that holds the others is filled anew until a tenth of `count` points is
/// effective. Throws std::invalid_argument for no values.
PosteriorSample posterior_sample(const std::vector<ObservedValues>& observed, Eigen::Index dimensions,
                                 Eigen::Index count = 16384);

/// Of one of the columns of a sample.
double weighted_mean(const Eigen::VectorXd& values, const Eigen::VectorXd& weights);
double weighted_deviation(const Eigen::VectorXd& values, const Eigen::VectorXd& weights);
double weighted_correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& weights);
/// The value that `part` (0..1) of all weight lies below.
double weighted_quantile(const Eigen::VectorXd& values, const Eigen::VectorXd& weights, double part);

/// Indices of `count` points of equal weight, rising, heavy points several times: those on which every 1/count of all
/// weight falls, taken in an order without a pattern, always the same.
std::vector<Eigen::Index> points_of_equal_weight(const Eigen::VectorXd& weights, std::size_t count);

}  // namespace vibrosow
