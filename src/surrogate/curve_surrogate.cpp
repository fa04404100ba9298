#include "surrogate/curve_surrogate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double variance_kept = 0.999;  // by the components
constexpr Index most_components = 6;

MatrixXd principal_components(const MatrixXd& centred) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(centred.transpose() * centred);
  const VectorXd variances = solver.eigenvalues().cwiseMax(0.0);  // ascending
  const double all = variances.sum();
  Index count = 0;
  double kept = 0;
  while (count < std::min(most_components, variances.size()) && (count == 0 || kept < variance_kept * all))
    kept += variances(variances.size() - 1 - count++);
  MatrixXd basis = solver.eigenvectors().rightCols(count).rowwise().reverse();
  for (Index k = 0; k < count; ++k)  // the sign of an eigenvector is nobody's choice
    if (basis.col(k).sum() < 0) basis.col(k) *= -1;
  return basis;
}

/// Scores of one run share its chance: their correlation is that of what the surrogates miss.
MatrixXd covariance_of_chance(const std::vector<GaussianProcess>& scores, const MatrixXd& errors) {
  const Index count = errors.cols();
  MatrixXd chance(count, count);
  for (Index a = 0; a < count; ++a)
    for (Index b = 0; b < count; ++b) {
      const double norm = std::sqrt(errors.col(a).squaredNorm() * errors.col(b).squaredNorm());
      const double correlation = a == b || norm == 0 ? (a == b ? 1 : 0) : errors.col(a).dot(errors.col(b)) / norm;
      chance(a, b) = correlation * std::sqrt(scores[static_cast<std::size_t>(a)].noise() *
                                             scores[static_cast<std::size_t>(b)].noise());
    }
  return chance;
}

}  // namespace

double CurveSurrogate::off_components2(const VectorXd& values) const {
  const VectorXd from_centre = values - centre;
  const VectorXd off = from_centre - basis * (basis.transpose() * from_centre);
  return off.squaredNorm() / static_cast<double>(off.size());
}

CurveSurrogate curve_surrogate(const MatrixXd& points, const MatrixXd& values) {
  CurveSurrogate surrogate;
  surrogate.centre = values.colwise().mean().transpose();
  surrogate.basis = principal_components(values.rowwise() - surrogate.centre.transpose());
  const MatrixXd scores = (values.rowwise() - surrogate.centre.transpose()) * surrogate.basis;
  MatrixXd errors(scores.rows(), scores.cols());
  for (Index k = 0; k < scores.cols(); ++k) {
    surrogate.scores.emplace_back(points, scores.col(k));
    errors.col(k) = surrogate.scores.back().left_out_errors();
  }
  surrogate.chance = covariance_of_chance(surrogate.scores, errors);
  return surrogate;
}

}  // namespace vibrosow
