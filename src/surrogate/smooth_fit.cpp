#include "surrogate/smooth_fit.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <stdexcept>

#include "portable_math/functions.hpp"
#include "selection/moments.hpp"

namespace vibrosow {
namespace {

constexpr std::array lengths = {0.15, 0.3, 0.6, 1.2,
                                2.5,  5.0, 20.0};           // of the unit cube's edge; the last: no influence
constexpr std::array scales = {0.3, 1.0, 3.0, 10.0, 30.0};  // variance of the process over the values'
constexpr std::size_t first_length = 3, first_scale = 1;
constexpr int most_passes = 5;
constexpr double enough_more = 1.1;   // values, over those of the last search for a shape
constexpr double least_ridge = 1e-6;  // over the values' variance: what keeps the matrix regular

}  // namespace

SmoothFit::SmoothFit(std::size_t axes) : shape_{std::vector<std::size_t>(axes, first_length), first_scale} {}

double SmoothFit::covariance(const std::vector<double>& one, const std::vector<double>& other) const {
  double squared = 0;
  for (std::size_t axis = 0; axis < one.size(); ++axis) {
    const double by = (one[axis] - other[axis]) / lengths[shape_.lengths[axis]];
    squared += by * by;
  }
  const double distance = std::sqrt(5 * squared);
  return scales[shape_.scale] * spread_ * (1 + distance + distance * distance / 3) * portable_math::exp(-distance);
}

/// But for a constant; leaves the root and weights of the shape.
double SmoothFit::log_likelihood() {
  const auto count = static_cast<Eigen::Index>(seen_.size());
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SeenValue& one = seen_[static_cast<std::size_t>(i)];
    values(i) = one.value - middle_;
    for (Eigen::Index j = 0; j <= i; ++j)
      matrix(i, j) = covariance(one.place, seen_[static_cast<std::size_t>(j)].place);
    matrix(i, i) += one.variance + least_ridge * spread_;
  }
  const Eigen::LLT<Eigen::MatrixXd> factors(matrix);  // of the lower half
  root_ = factors.matrixLLT();
  weights_ = factors.solve(values);
  double log_root = 0;  // of the determinant
  for (Eigen::Index i = 0; i < count; ++i) log_root += portable_math::log(root_(i, i));
  return -0.5 * values.dot(weights_) - log_root;
}

void SmoothFit::fit(std::vector<SeenValue> seen) {
  if (seen.size() < 2) throw std::invalid_argument("a smooth fit goes through two values at least");
  seen_ = std::move(seen);
  Moments moments;
  for (const SeenValue& one : seen_) moments.add(one.value);
  middle_ = moments.mean();
  spread_ = moments.variance() > 0 ? moments.variance() : 1;
  double best = log_likelihood();
  if (static_cast<double>(seen_.size()) < enough_more * static_cast<double>(shaped_for_)) return;
  shaped_for_ = seen_.size();
  const auto improve = [&](std::size_t& index, std::size_t choices) {
    const std::size_t before = index;
    std::size_t kept = before;
    for (const std::size_t other : {before - 1, before + 1}) {
      if (other >= choices) continue;
      index = other;
      if (const double here = log_likelihood(); here > best) best = here, kept = other;
    }
    index = kept;
  };
  for (int pass = 0; pass < most_passes; ++pass) {
    const double before = best;
    for (std::size_t& length : shape_.lengths) improve(length, lengths.size());
    improve(shape_.scale, scales.size());
    if (!(best > before)) break;
  }
  log_likelihood();
}

SmoothFit::Prediction SmoothFit::at(const std::vector<double>& place) const {
  Eigen::VectorXd with(weights_.size());
  for (Eigen::Index i = 0; i < with.size(); ++i) with(i) = covariance(place, seen_[static_cast<std::size_t>(i)].place);
  const Eigen::VectorXd known = root_.triangularView<Eigen::Lower>().solve(with);
  const double variance = scales[shape_.scale] * spread_ - known.squaredNorm();
  return {middle_ + with.dot(weights_), std::sqrt(std::max(0.0, variance))};
}

}  // namespace vibrosow
