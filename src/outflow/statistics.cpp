#include "outflow/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Two passes: values far from zero and close together keep their digits.
double sample_deviation(const std::vector<double>& values, double mean) {
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

MeanWithInterval mean_of_at_least(double least_deviation, const std::vector<double>& values) {
  if (values.empty()) return {std::numeric_limits<double>::quiet_NaN(), std::nullopt};
  const double mean = mean_of(values);
  if (values.size() < 2) return {mean, std::nullopt};
  const auto count = static_cast<double>(values.size());
  const double deviation = std::max(sample_deviation(values, mean), least_deviation);
  return {mean, student_t_95(count - 1) * deviation / std::sqrt(count)};
}

}  // namespace

double student_t_95(double degrees_of_freedom) {
  return students_t_quantile(degrees_of_freedom, 0.975);
}

MeanWithInterval mean_with_interval(const std::vector<double>& values) {
  return mean_of_at_least(0, values);
}

double scatter_of_counting(const std::vector<CountedRate>& rates) {
  double of_a_seed = 0;
  for (const auto& [rate, seeds] : rates)
    if (seeds > 0) of_a_seed = std::max(of_a_seed, std::abs(rate) / seeds);
  return of_a_seed / std::sqrt(12);
}

MeanWithInterval mean_of_rates(const std::vector<CountedRate>& rates) {
  std::vector<double> values;
  for (const CountedRate& one : rates) values.push_back(one.rate);
  return mean_of_at_least(scatter_of_counting(rates), values);
}

std::optional<double> coefficient_of_variation(const std::vector<double>& values) {
  if (values.size() < 2) return std::nullopt;
  const double mean = mean_of(values);
  if (mean == 0) return std::nullopt;
  return sample_deviation(values, mean) / mean;
}

}  // namespace vibrosow
