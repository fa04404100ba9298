#include "surrogate/posterior_sample.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "distributions/distributions.hpp"
#include "surrogate/sobol_points.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_rounds = 8;
constexpr double wanted_share = 0.1;    // of the points, effective
constexpr double negligible_drop = 14;  // below the largest logarithm of a likelihood; 1e-6 of it
constexpr double margin = 0.1;          // about the box of points that weigh, of its width

/// What the likelihood of a shift needs of a point: with S the covariance and r the residuals, 1'S^-1 1, 1'S^-1 r and
/// r'S^-1 r of the shifted values, the last of the others, and the logarithm of the determinant.
struct Sums {
  double ones = 0, cross = 0, squares = 0, log_determinant = 0;
};

void add(Sums& sums, const ObservedValues& observed, const VectorXd& means, const VectorXd& variances) {
  MatrixXd covariance = observed.chance;
  covariance.diagonal() += variances;
  const Eigen::LLT<MatrixXd> factor(covariance);
  VectorXd residuals = observed.values - means;
  factor.matrixL().solveInPlace(residuals);
  sums.squares += residuals.squaredNorm();
  sums.log_determinant += 2 * factor.matrixLLT().diagonal().array().log().sum();
  if (!observed.shifted) return;
  VectorXd ones = VectorXd::Ones(means.size());
  factor.matrixL().solveInPlace(ones);
  sums.ones += ones.squaredNorm();
  sums.cross += ones.dot(residuals);
}

/// What the values say of each point.
struct Likelihoods {
  VectorXd logarithms;
  VectorXd misfits;                   // chi squared, with the best shift
  VectorXd shifts, shift_deviations;  // of the shift given the point
};

Likelihoods likelihoods(const std::vector<ObservedValues>& observed, const MatrixXd& points) {
  std::vector<Sums> sums(static_cast<std::size_t>(points.rows()));
  for (const ObservedValues& one : observed) {
    MatrixXd means(points.rows(), one.values.size()), variances(points.rows(), one.values.size());
    for (Index k = 0; k < one.values.size(); ++k) {
      const GaussianPrediction prediction = one.surrogates[static_cast<std::size_t>(k)]->at(points);
      means.col(k) = prediction.mean;
      variances.col(k) = prediction.variance;
    }
    for (Index i = 0; i < points.rows(); ++i)
      add(sums[static_cast<std::size_t>(i)], one, means.row(i).transpose(), variances.row(i).transpose());
  }
  const Index count = points.rows();
  Likelihoods result{VectorXd(count), VectorXd(count), VectorXd::Zero(count), VectorXd::Zero(count)};
  for (Index i = 0; i < count; ++i) {
    const Sums& of = sums[static_cast<std::size_t>(i)];
    double misfit = of.squares, log_width = 0;
    if (of.ones > 0) {
      misfit -= of.cross * of.cross / of.ones;
      log_width = -0.5 * std::log(of.ones);
      result.shifts(i) = of.cross / of.ones;
      result.shift_deviations(i) = 1 / std::sqrt(of.ones);
    }
    result.misfits(i) = misfit;
    result.logarithms(i) = -0.5 * (misfit + of.log_determinant) + log_width;
  }
  return result;
}

struct Box {
  VectorXd low, high;
};

Box box_of_weighty(const MatrixXd& points, const VectorXd& logarithms) {
  Box box{VectorXd::Ones(points.cols()), VectorXd::Zero(points.cols())};
  const double most = logarithms.maxCoeff();
  for (Index i = 0; i < points.rows(); ++i) {
    if (logarithms(i) < most - negligible_drop) continue;
    box.low = box.low.cwiseMin(points.row(i).transpose());
    box.high = box.high.cwiseMax(points.row(i).transpose());
  }
  const VectorXd width = (box.high - box.low).cwiseMax(1e-6);
  box.low = (box.low - margin * width).cwiseMax(0.0);
  box.high = (box.high + margin * width).cwiseMin(1.0);
  return box;
}

VectorXd weights_of(const VectorXd& logarithms) {
  const VectorXd weights = (logarithms.array() - logarithms.maxCoeff()).exp();
  return weights / weights.sum();
}

/// Indices by rising value.
std::vector<Index> order_of(const VectorXd& values) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index i) { return values(i); });
  return order;
}

/// Indices in an order without a pattern. In their own, Sobol's points fill the same boxes in turn: equal steps through
/// their weights would fall into step with that, and take a few of the boxes alone.
std::vector<Index> without_pattern(Index count) {
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  std::mt19937_64 engine;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[engine() % i]);
  return order;
}

}  // namespace

PosteriorSample posterior_sample(const std::vector<ObservedValues>& observed, Index dimensions, Index count) {
  if (observed.empty()) throw std::invalid_argument("nothing was observed");
  const bool shifted = std::ranges::any_of(observed, &ObservedValues::shifted);
  const MatrixXd cube = sobol_points(count, dimensions + (shifted ? 1 : 0));
  Box box{VectorXd::Zero(dimensions), VectorXd::Ones(dimensions)};
  PosteriorSample result;
  for (int round = 0; round < most_rounds; ++round) {
    result.points = cube.leftCols(dimensions) * (box.high - box.low).asDiagonal();
    result.points.rowwise() += box.low.transpose();
    const Likelihoods likely = likelihoods(observed, result.points);
    result.weights = weights_of(likely.logarithms);
    result.effective_points = 1 / result.weights.squaredNorm();
    result.least_misfit = likely.misfits.minCoeff();
    if (shifted) {
      result.shifts = likely.shifts;
      for (Index i = 0; i < count; ++i)
        result.shifts(i) += likely.shift_deviations(i) * normal_quantile(cube(i, dimensions));
    }
    if (result.effective_points >= wanted_share * static_cast<double>(count)) break;
    const Box smaller = box_of_weighty(result.points, likely.logarithms);
    if ((smaller.high - smaller.low).prod() > 0.9 * (box.high - box.low).prod()) break;
    box = smaller;
  }
  return result;
}

double weighted_mean(const VectorXd& values, const VectorXd& weights) {
  return values.dot(weights);
}

double weighted_deviation(const VectorXd& values, const VectorXd& weights) {
  return std::sqrt((values.array() - weighted_mean(values, weights)).square().matrix().dot(weights));
}

double weighted_correlation(const VectorXd& a, const VectorXd& b, const VectorXd& weights) {
  const double deviations = weighted_deviation(a, weights) * weighted_deviation(b, weights);
  const Eigen::ArrayXd products = (a.array() - weighted_mean(a, weights)) * (b.array() - weighted_mean(b, weights));
  return deviations > 0 ? products.matrix().dot(weights) / deviations : 0;
}

double weighted_quantile(const VectorXd& values, const VectorXd& weights, double part) {
  const std::vector<Index> order = order_of(values);
  double below = 0;  // weight below the middle of the value's own
  double last_value = values(order.front()), last_below = 0;
  for (const Index i : order) {
    const double middle = below + weights(i) / 2;
    if (middle >= part) {
      const double width = middle - last_below;
      return width > 0 ? last_value + (values(i) - last_value) * (part - last_below) / width : values(i);
    }
    last_value = values(i), last_below = middle;
    below += weights(i);
  }
  return last_value;
}

std::vector<Index> points_of_equal_weight(const VectorXd& weights, std::size_t count) {
  const std::vector<Index> order = without_pattern(weights.size());
  std::vector<Index> points;
  std::size_t place = 0;
  double below = weights(order.front());  // weight of the points up to this place
  for (std::size_t k = 0; k < count; ++k) {
    const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (below < part && place + 1 < order.size()) below += weights(order[++place]);
    points.push_back(order[place]);
  }
  std::ranges::sort(points);
  return points;
}

}  // namespace vibrosow
