#include "agronomy/prediction_error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

constexpr double tail = 0.025;  // beyond each end of a range
constexpr int nodes = 200;      // of the variance that is drawn

double square(double value) {
  return value * value;
}

/// Student's t is a normal of variance freedom / chi squared: these, of equal probability.
std::vector<double> drawn_variances(const ModelError& model) {
  if (model.materials == 0) return {0};
  std::vector<double> variances;
  for (int k = 0; k < nodes; ++k)
    variances.push_back(square(model.scale) * model.materials /
                        chi_squared_quantile(model.materials, (k + 0.5) / nodes));
  return variances;
}

/// The value below which `share` lies; `below(x)` is what lies below x.
template <class Below>
double quantile(double share, Below below) {
  const auto excess = [&](double value) { return below(value) - share; };
  double low = -1, high = 1;
  while (excess(low) > 0) low *= 2;
  while (excess(high) < 0) high *= 2;
  std::uintmax_t most_steps = 100;
  const auto [from, to] = boost::math::tools::toms748_solve(excess, low, high, excess(low), excess(high),
                                                            boost::math::tools::eps_tolerance<double>(30), most_steps);
  return 0.5 * (from + to);
}

}  // namespace

ModelError model_error(const std::vector<double>& log_ratios) {
  if (log_ratios.empty() || !std::ranges::all_of(log_ratios, [](double one) { return std::isfinite(one); }))
    throw std::invalid_argument("a model's error is known from finite ratios, at least one");
  double sum = 0, squares = 0;
  for (const double one : log_ratios) sum += one, squares += one * one;
  const auto count = static_cast<double>(log_ratios.size());
  return {std::sqrt(squares / count), static_cast<int>(log_ratios.size()), std::exp(sum / count)};
}

FactorRange expected_range(const PredictionError& error) {
  return WeighedRates(error, {}).at(error.chance).range;
}

double half_width_of_normal(double deviation) {
  return std::sinh(normal_quantile(1 - tail) * deviation);
}

double deviation_of_half_width(double half_width) {
  return std::asinh(half_width) / normal_quantile(1 - tail);
}

double half_width_of_model(const PredictionError& error) {
  const ModelError& model = error.model;
  if (model.materials == 0) return half_width_of_normal(error.setting);
  if (error.setting == 0) return std::sinh(students_t_quantile(model.materials, 1 - tail) * model.scale);
  const FactorRange range = expected_range({.model = model, .setting = error.setting});
  return 0.5 * (range.high - range.low);
}

WeighedRates::WeighedRates(const PredictionError& error, std::vector<Weighing> weighings)
    : tolerance_(square(error.tolerance)),
      numerics_(square(error.numerics)),
      variances_(drawn_variances(error.model)),
      setting_spread_(error.setting),
      weighings_(std::move(weighings)) {}

double common_share(const SettingPlace& a, const SettingPlace& b) {
  double share = 1;
  for (std::size_t k = 0; k < a.size(); ++k) share *= std::max(0.0, 1 - std::abs(a[k] - b[k]));
  return share;
}

std::vector<WeighedRates::Normal> WeighedRates::mixture(const std::vector<Weighing>& weighings, double own_deviation,
                                                        const std::optional<SettingPlace>& setting,
                                                        const std::optional<double>& tolerance) const {
  const auto count = static_cast<Eigen::Index>(weighings.size());
  const auto row = [&](Eigen::Index i) -> const Weighing& { return weighings[static_cast<std::size_t>(i)]; };
  const auto own_part = [&](double deviation) { return std::hypot(setting_spread_, deviation); };
  const double asked_variance = square(own_part(own_deviation));
  Eigen::MatrixXd own(count, count);             // of the settings, and of the weighings
  Eigen::VectorXd values(count), shared(count);  // with the prediction that is asked for
  for (Eigen::Index i = 0; i < count; ++i) {
    const double part = own_part(row(i).own_deviation);
    values(i) = row(i).log_ratio;
    shared(i) = setting ? common_share(*setting, row(i).setting) * part * own_part(own_deviation) : 0;
    for (Eigen::Index k = 0; k < count; ++k)
      own(i, k) = common_share(row(i).setting, row(k).setting) * part * own_part(row(k).own_deviation);
    own(i, i) += square(row(i).deviation);
  }
  std::vector<Normal> normals;
  double largest = -std::numeric_limits<double>::infinity();
  for (const double variance : variances_) {
    const double weighed = variance + numerics_ + tolerance_;  // what all that was weighed has in common
    const double common = tolerance ? variance + numerics_ : weighed;
    const double asked = variance + numerics_ + (tolerance ? square(*tolerance) : tolerance_) + asked_variance;
    Normal normal{0, 0, std::sqrt(asked)};
    if (count > 0) {
      const Eigen::LDLT<Eigen::MatrixXd> solver(own + Eigen::MatrixXd::Constant(count, count, weighed));
      const Eigen::VectorXd with = shared.array() + common;
      const Eigen::VectorXd solved = solver.solve(with);
      normal.mean = solved.dot(values);
      normal.deviation = std::sqrt(std::max(0.0, asked - solved.dot(with)));
      normal.weight = -0.5 * (solver.vectorD().array().log().sum() + values.dot(solver.solve(values)));
    }
    largest = std::max(largest, normal.weight);
    normals.push_back(normal);
  }
  double sum = 0;
  for (Normal& normal : normals) sum += normal.weight = std::exp(normal.weight - largest);
  for (Normal& normal : normals) normal.weight /= sum;
  return normals;
}

namespace {

template <class Normals>
double below(const Normals& normals, double value) {
  double share = 0;
  for (const auto& normal : normals)
    share += normal.weight * (normal.deviation > 0 ? normal_below((value - normal.mean) / normal.deviation)
                                                   : static_cast<double>(value >= normal.mean));
  return share;
}

}  // namespace

WeighedRates::Answer WeighedRates::at(double own_deviation, const std::optional<SettingPlace>& setting,
                                      const std::optional<double>& tolerance) const {
  const std::vector<Normal> normals = mixture(weighings_, own_deviation, setting, tolerance);
  const auto factor = [&](double share) {
    return std::exp(quantile(share, [&](double value) { return below(normals, value); }));
  };
  return {factor(0.5), {factor(tail), factor(1 - tail)}};
}

std::vector<double> WeighedRates::surprise() const {
  std::vector<double> shares;
  for (std::size_t i = 0; i < weighings_.size(); ++i) {
    std::vector<Weighing> others = weighings_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Weighing& one = weighings_[i];
    std::vector<Normal> normals = mixture(others, one.own_deviation, one.setting, std::nullopt);
    for (Normal& normal : normals) normal.deviation = std::hypot(normal.deviation, one.deviation);
    const double share = std::clamp(below(normals, one.log_ratio), 0.0, 1.0);  // sums of shares end off 1 by rounding
    shares.push_back(2 * std::min(share, 1 - share));
  }
  return shares;
}

}  // namespace vibrosow
