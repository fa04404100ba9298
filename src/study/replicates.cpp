#include "study/replicates.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrosow {
namespace {

std::vector<CountedRate> that_flowed(const std::vector<std::optional<CountedRate>>& rates) {
  std::vector<CountedRate> flowed;
  for (const auto& rate : rates)
    if (rate) flowed.push_back(*rate);
  return flowed;
}

/// Half width of the interval over the mean; endless where there is none yet.
double relative_half_width(const std::vector<CountedRate>& rates) {
  const MeanWithInterval mean = mean_of_rates(rates);
  return mean.half_width_95 && mean.mean != 0 ? *mean.half_width_95 / std::abs(mean.mean) : HUGE_VAL;
}

}  // namespace

std::optional<int> enough_runs(const std::vector<std::optional<CountedRate>>& rates, const Replicates& wanted) {
  if (!wanted.interval) throw std::logic_error("no interval is wanted");
  std::vector<CountedRate> flowed;
  for (std::size_t n = 0; n < rates.size(); ++n) {
    if (rates[n]) flowed.push_back(*rates[n]);
    if (static_cast<int>(flowed.size()) >= Replicates::least_by_interval &&
        relative_half_width(flowed) <= *wanted.interval)
      return static_cast<int>(n) + 1;
  }
  return std::nullopt;
}

int runs_to_go_to(const std::vector<std::optional<CountedRate>>& rates, const Replicates& wanted) {
  const int now = static_cast<int>(rates.size());
  if (enough_runs(rates, wanted) || now >= wanted.most) return now;
  const double over = relative_half_width(that_flowed(rates)) / *wanted.interval;
  const double needed = std::min(std::ceil(now * over * over), 2.0 * now);
  return std::clamp(static_cast<int>(needed), now + 1, wanted.most);
}

bool look_skewed(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  if (n < 10) return false;
  const double mean = mean_with_interval(values).mean;
  double squares = 0, cubes = 0;
  for (const double value : values) {
    const double from_mean = value - mean;
    squares += from_mean * from_mean;
    cubes += from_mean * from_mean * from_mean;
  }
  if (!(squares > 0)) return false;
  const double skewness =
      std::sqrt(n * (n - 1)) / (n - 2) * (cubes / n) / std::sqrt(squares / n * squares / n * squares / n);
  const double standard_error = std::sqrt(6 * n * (n - 1) / ((n - 2) * (n + 1) * (n + 3)));
  return std::abs(skewness) > 2 * standard_error;
}

}  // namespace vibrosow
