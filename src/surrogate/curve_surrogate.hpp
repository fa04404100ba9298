#pragma once

#include <Eigen/Core>
#include <vector>

#include "surrogate/gaussian_process.hpp"

namespace vibrosow {

/// Several values of a run together, such as a curve's, over the unit cube: their principal components, those that make
/// up 99.9 % of the runs' differences but six at most, each with a Gaussian process through its scores. A single value
/// is its own score.
struct CurveSurrogate {
  Eigen::VectorXd centre;               // mean of the runs
  Eigen::MatrixXd basis;                // a component a column, orthonormal
  std::vector<GaussianProcess> scores;  // of each component
  Eigen::MatrixXd chance;               // covariance of the scores of one run

  Eigen::VectorXd scores_of(const Eigen::VectorXd& values) const { return basis.transpose() * (values - centre); }
  /// Mean square of what of the values no sum of components follows.
  double off_components2(const Eigen::VectorXd& values) const;
};

/// `points`: of the runs, one a row, in the unit cube; `values`: of each run a row. Throws std::invalid_argument as
/// GaussianProcess does.
CurveSurrogate curve_surrogate(const Eigen::MatrixXd& points, const Eigen::MatrixXd& values);

}  // namespace vibrosow
