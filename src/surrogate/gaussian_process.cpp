#include "surrogate/gaussian_process.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "distributions/distributions.hpp"
#include "surrogate/sobol_points.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double shortest = 0.05, longest = 20;         // lengths tried
constexpr double least_noise = 1e-8, most_noise = 1e4;  // over the signal's variance, tried
constexpr int most_tries = 400;                         // of each start
constexpr Index many_values = 40;    // from here on four covariances beside the likeliest are enough, below it eight
constexpr double widened = 1.2;      // they are drawn this much wider than the likelihood is
constexpr double negligible = 1e-3;  // weight
constexpr double least_width = 0.05, most_width = 1.5;  // of the likelihood along a parameter's logarithm

/// Matern's function of order 5/2, of a distance times the square root of 5.
double matern(double r) {
  return (1 + r + r * r / 3) * std::exp(-r);
}

/// It for every pair of rows.
MatrixXd correlations(const MatrixXd& a, const MatrixXd& b, const VectorXd& lengths) {
  const MatrixXd x = (a.array().rowwise() / lengths.transpose().array()).matrix().transpose();
  const MatrixXd y = (b.array().rowwise() / lengths.transpose().array()).matrix().transpose();
  MatrixXd result(a.rows(), b.rows());
  for (Index j = 0; j < b.rows(); ++j)
    for (Index i = 0; i < a.rows(); ++i) result(i, j) = matern(std::sqrt(5 * (x.col(i) - y.col(j)).squaredNorm()));
  return result;
}

/// The same of one set, the lower half alone, which is what a Cholesky factor is made of.
MatrixXd lower_correlations(const MatrixXd& points, const VectorXd& lengths) {
  const MatrixXd x = (points.array().rowwise() / lengths.transpose().array()).matrix().transpose();
  MatrixXd result = MatrixXd::Identity(points.rows(), points.rows());
  for (Index j = 0; j < x.cols(); ++j)
    for (Index i = j + 1; i < x.cols(); ++i) result(i, j) = matern(std::sqrt(5 * (x.col(i) - x.col(j)).squaredNorm()));
  return result;
}

/// Columns 1, x1, x2, ..
MatrixXd trend_of(const MatrixXd& points) {
  MatrixXd trend(points.rows(), points.cols() + 1);
  trend.col(0).setOnes();
  trend.rightCols(points.cols()) = points;
  return trend;
}

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

/// The restricted likelihood of the logarithms of the lengths and of noise over signal.
class Likelihood {
 public:
  Likelihood(const MatrixXd& points, const VectorXd& values)
      : points_(points), trend_(trend_of(points)), values_(values) {}

  /// Less is better; the signal's variance, which has a best value of its own, is kept.
  double cost(const double* logarithms) {
    const Index dimensions = points_.cols();
    const VectorXd logs = Eigen::Map<const VectorXd>(logarithms, dimensions);
    const VectorXd lengths = logs.array().exp();
    MatrixXd matrix = lower_correlations(points_, lengths);
    matrix.diagonal().array() += std::exp(logarithms[dimensions]);
    const Eigen::LLT<MatrixXd> factor(matrix);
    const MatrixXd weighted_trend = factor.solve(trend_);
    const Eigen::LLT<MatrixXd> trend_factor(trend_.transpose() * weighted_trend);
    const VectorXd residual = values_ - trend_ * trend_factor.solve(weighted_trend.transpose() * values_);
    const double freedom = static_cast<double>(values_.size() - trend_.cols());
    signal_ = std::max(residual.dot(factor.solve(residual)) / freedom, 1e-300);
    const double likelihood =
        -0.5 * (freedom * std::log(signal_) + log_determinant(factor) + log_determinant(trend_factor));
    const double result = 0.5 * logs.squaredNorm() - likelihood;
    return std::isfinite(result) ? result : 1e300;
  }

  double signal() const { return signal_; }

 private:
  const MatrixXd& points_;
  MatrixXd trend_;
  const VectorXd& values_;
  double signal_ = 1;
};

double cost_of(unsigned, const double* logarithms, double*, void* likelihood) {
  return static_cast<Likelihood*>(likelihood)->cost(logarithms);
}

/// From one start to the nearest best.
double descend(Likelihood& likelihood, std::vector<double>& logarithms) {
  const auto count = static_cast<unsigned>(logarithms.size());
  std::vector<double> low(count, std::log(shortest)), high(count, std::log(longest)), step(count, 0.5);
  low.back() = std::log(least_noise), high.back() = std::log(most_noise), step.back() = 1;
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> search(nlopt_create(NLOPT_LN_BOBYQA, count),
                                                                      nlopt_destroy);
  nlopt_set_lower_bounds(search.get(), low.data());
  nlopt_set_upper_bounds(search.get(), high.data());
  nlopt_set_initial_step(search.get(), step.data());
  nlopt_set_min_objective(search.get(), cost_of, &likelihood);
  nlopt_set_xtol_abs1(search.get(), 1e-3);
  nlopt_set_maxeval(search.get(), most_tries);
  double cost = 1e300;
  nlopt_optimize(search.get(), logarithms.data(), &cost);  // where it gives up it leaves the best that it found
  return cost;
}

using Logarithms = std::vector<double>;

Logarithms likeliest(Likelihood& likelihood, std::size_t dimensions) {
  Logarithms best;
  double least = 2e300;
  for (const auto& [length, noise] : {std::pair{0.5, 0.1}, std::pair{2.0, 1e-3}}) {
    Logarithms logarithms(dimensions, std::log(length));
    logarithms.push_back(std::log(noise));
    const double cost = descend(likelihood, logarithms);
    if (cost < least) best = logarithms, least = cost;
  }
  return best;
}

/// Standard deviation of the likelihood along each parameter, from its curvature.
VectorXd widths(Likelihood& likelihood, const Logarithms& best) {
  constexpr double step = 0.3;
  const double least = likelihood.cost(best.data());
  VectorXd result(static_cast<Index>(best.size()));
  for (std::size_t k = 0; k < best.size(); ++k) {
    Logarithms up = best, down = best;
    up[k] += step, down[k] -= step;
    const double curvature = (likelihood.cost(up.data()) + likelihood.cost(down.data()) - 2 * least) / (step * step);
    const double width = curvature > 0 ? 1 / std::sqrt(curvature) : most_width;
    result(static_cast<Index>(k)) = std::clamp(width, least_width, most_width);
  }
  return result;
}

struct Candidate {
  double log_weight;
  Covariance covariance;
};

/// The likeliest covariance first, then those drawn about it.
std::vector<Candidate> candidates(const MatrixXd& points, const VectorXd& values) {
  const Index dimensions = points.cols();
  const double spread2 = (values.array() - values.mean()).square().mean();
  const double scale2 = spread2 > 0 ? spread2 : 1;
  const VectorXd scaled = (values.array() - values.mean()) / std::sqrt(scale2);
  Likelihood likelihood(points, scaled);
  const Logarithms best = likeliest(likelihood, static_cast<std::size_t>(dimensions));
  const VectorXd width = widened * widths(likelihood, best);
  // The mean of a variance whose inverse is gamma distributed.
  const double freedom = static_cast<double>(values.size() - dimensions - 1);
  const double of_variance = scale2 * freedom / (freedom - 2);
  std::vector<Candidate> result;
  const auto add = [&](const Logarithms& at, double half_squares) {
    Candidate candidate{half_squares - likelihood.cost(at.data()), {}};
    candidate.covariance.lengths = Eigen::Map<const VectorXd>(at.data(), dimensions).array().exp();
    candidate.covariance.signal = likelihood.signal() * of_variance;
    candidate.covariance.noise = candidate.covariance.signal * std::exp(at.back());
    result.push_back(std::move(candidate));
  };
  add(best, 0);
  const Index drawn = values.size() < many_values ? 8 : 4;
  const MatrixXd cube = sobol_points(drawn, dimensions + 1);
  for (Index i = 0; i < drawn; ++i) {
    Logarithms at = best;
    double half_squares = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double deviate = normal_quantile(cube(i, static_cast<Index>(k)));
      const double low = k + 1 < at.size() ? shortest : least_noise, high = k + 1 < at.size() ? longest : most_noise;
      at[k] = std::clamp(at[k] + width(static_cast<Index>(k)) * deviate, std::log(low), std::log(high));
      half_squares += deviate * deviate / 2;
    }
    add(at, half_squares);
  }
  return result;
}

}  // namespace

Kriging::Kriging(MatrixXd points, const VectorXd& values, Covariance covariance)
    : points_(std::move(points)), covariance_(std::move(covariance)) {
  MatrixXd matrix = covariance_.signal * lower_correlations(points_, covariance_.lengths);
  // Noise below what a double can tell from none would leave equal points without an inverse.
  matrix.diagonal().array() += std::max(covariance_.noise, 1e-12 * covariance_.signal);
  values_factor_.compute(matrix);
  const MatrixXd trend = trend_of(points_);
  weighted_trend_ = values_factor_.solve(trend);
  trend_factor_.compute(trend.transpose() * weighted_trend_);
  coefficients_ = trend_factor_.solve(weighted_trend_.transpose() * values);
  weighted_ = values_factor_.solve(values - trend * coefficients_);
}

GaussianPrediction Kriging::at(const MatrixXd& points) const {
  constexpr Index at_a_time = 256;
  GaussianPrediction prediction{VectorXd(points.rows()), VectorXd(points.rows())};
  for (Index from = 0; from < points.rows(); from += at_a_time) {
    const Index count = std::min(at_a_time, points.rows() - from);
    const MatrixXd here = points.middleRows(from, count);
    const MatrixXd trend = trend_of(here);
    MatrixXd cross = covariance_.signal * correlations(points_, here, covariance_.lengths);
    prediction.mean.segment(from, count) = trend * coefficients_ + cross.transpose() * weighted_;
    MatrixXd unexplained = (trend - cross.transpose() * weighted_trend_).transpose();
    values_factor_.matrixL().solveInPlace(cross);
    trend_factor_.matrixL().solveInPlace(unexplained);
    prediction.variance.segment(from, count) =
        (covariance_.signal - cross.colwise().squaredNorm().array() + unexplained.colwise().squaredNorm().array())
            .max(0.0);
  }
  return prediction;
}

VectorXd Kriging::left_out_errors() const {
  const MatrixXd inverse = values_factor_.solve(MatrixXd::Identity(points_.rows(), points_.rows()));
  const MatrixXd of_residuals = inverse - weighted_trend_ * trend_factor_.solve(weighted_trend_.transpose());
  return weighted_.array() / of_residuals.diagonal().array().max(1e-300).sqrt();
}

GaussianProcess::GaussianProcess(const MatrixXd& points, const VectorXd& values) {
  if (values.size() < points.cols() + 4) throw std::invalid_argument("too few values for a Gaussian process");
  if (!values.allFinite()) throw std::invalid_argument("a value is not finite");
  const std::vector<Candidate> all = candidates(points, values);
  const double most = std::ranges::max_element(all, {}, &Candidate::log_weight)->log_weight;
  double sum = 0;
  for (const Candidate& candidate : all) sum += std::exp(candidate.log_weight - most);
  for (const Candidate& candidate : all) {
    const double weight = std::exp(candidate.log_weight - most) / sum;
    if (members_.empty() || weight > negligible)
      members_.push_back({weight, Kriging(points, values, candidate.covariance)});
  }
}

GaussianPrediction GaussianProcess::at(const MatrixXd& points) const {
  VectorXd mean = VectorXd::Zero(points.rows()), square = VectorXd::Zero(points.rows());
  double weights = 0;
  std::vector<GaussianPrediction> predictions;
  for (const Member& member : members_) {
    predictions.push_back(member.kriging.at(points));
    mean += member.weight * predictions.back().mean;
    weights += member.weight;
  }
  mean /= weights;
  for (std::size_t k = 0; k < members_.size(); ++k)
    square += members_[k].weight / weights *
              (predictions[k].variance.array() + (predictions[k].mean - mean).array().square()).matrix();
  return {mean, square};
}

double GaussianProcess::noise() const {
  double sum = 0, weights = 0;
  for (const Member& member : members_) {
    sum += member.weight * member.kriging.covariance().noise;
    weights += member.weight;
  }
  return sum / weights;
}

}  // namespace vibrosow
