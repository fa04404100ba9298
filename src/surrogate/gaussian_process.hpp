#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace vibrosow {

/// Covariance of a function over the unit cube: Matern's of order 5/2 with a length along each dimension. All variances
/// are in the values' unit squared.
struct Covariance {
  Eigen::VectorXd lengths;
  double signal = 1;  // variance of the function about its trend
  double noise = 0;   // variance of a single value's own chance
};

struct GaussianPrediction {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;  // of the function, without the chance of a single value
};

/// What one covariance makes of values at points: universal kriging with a linear trend of flat prior (Rasmussen &
/// Williams 2006, "Gaussian Processes for Machine Learning", section 2.7).
class Kriging {
 public:
  Kriging(Eigen::MatrixXd points, const Eigen::VectorXd& values, Covariance covariance);

  GaussianPrediction at(const Eigen::MatrixXd& points) const;
  /// How far each value lies from what all others say of it, over the standard deviation of that difference (Dubrule
  /// 1983).
  Eigen::VectorXd left_out_errors() const;
  const Covariance& covariance() const { return covariance_; }

 private:
  Eigen::MatrixXd points_;
  Covariance covariance_;
  Eigen::LLT<Eigen::MatrixXd> values_factor_, trend_factor_;
  Eigen::MatrixXd weighted_trend_;  // K^-1 H
  Eigen::VectorXd coefficients_;    // of the trend
  Eigen::VectorXd weighted_;        // K^-1 (values - trend)
};

/// Regression by a Gaussian process whose covariance is not known: kriging with some covariances that the values allow,
/// weighed by how likely they are. Every value has chance of the same variance, which is estimated too; values at equal
/// points tell it apart best. With the likeliest covariance alone, intervals would be too narrow where values are few.
///
/// The likelihood is the restricted one (Rasmussen & Williams, sections 2.7 and 5.4), the variance's scale integrated
/// out; the prior of lengths is lognormal about 1 with a standard deviation of 1 in the logarithm. Its largest value is
/// found by BOBYQA (Powell 2009, in NLopt); about it covariances lie on Sobol's points of a normal distribution as wide
/// as the likelihood along each parameter, and are weighed by importance.
class GaussianProcess {
 public:
  /// `points`: one a row, in the unit cube. Throws std::invalid_argument where there are fewer than three values more
  /// than the trend has coefficients, or values that are not finite.
  GaussianProcess(const Eigen::MatrixXd& points, const Eigen::VectorXd& values);

  GaussianPrediction at(const Eigen::MatrixXd& points) const;

  /// Of the likeliest covariance.
  Eigen::VectorXd left_out_errors() const { return members_.front().kriging.left_out_errors(); }
  const Covariance& covariance() const { return members_.front().kriging.covariance(); }

  /// Variance of a single value's own chance, over all covariances.
  double noise() const;

 private:
  struct Member {
    double weight;
    Kriging kriging;
  };
  std::vector<Member> members_;  // the likeliest first
};

}  // namespace vibrosow
