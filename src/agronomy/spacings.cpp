#include "agronomy/spacings.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "outflow/statistics.hpp"

namespace vibrosow {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// n - 1; none for fewer than two.
std::optional<double> deviation_of(const std::vector<double>& values) {
  const std::optional<double> cv = coefficient_of_variation(values);
  return cv ? std::optional(*cv * mean_of(values)) : std::nullopt;
}

}  // namespace

std::optional<SpacingMetrics> spacing_metrics(const std::vector<Spacing>& spacings, const SpacingLimits& limits) {
  if (!(limits.multiples_below > 0) || !(limits.skips_above > limits.multiples_below))
    throw std::invalid_argument("the limits of multiples and skips are not in order");
  if (spacings.empty()) return std::nullopt;
  const auto count = static_cast<double>(spacings.size());
  SpacingMetrics metrics;
  metrics.spacings = static_cast<std::int64_t>(spacings.size());
  std::vector<double> all, between;
  double multiples = 0, skips = 0;
  for (const Spacing& one : spacings) {
    if (!(one.reference > 0)) throw std::invalid_argument("a reference spacing is not positive");
    const double parts = one.length / one.reference;
    metrics.mean += one.length / count;
    metrics.reference += one.reference / count;
    metrics.deviation += std::abs(one.length - one.reference) / count;
    all.push_back(parts);
    if (parts <= limits.multiples_below)
      ++multiples;
    else if (parts > limits.skips_above)
      ++skips;
    else
      between.push_back(parts);
  }
  metrics.multiples = multiples / count;
  metrics.skips = skips / count;
  metrics.singles = static_cast<double>(between.size()) / count;
  metrics.precision = deviation_of(between);
  metrics.cv = coefficient_of_variation(all);
  return metrics;
}

std::vector<Spacing> spacings_of(const std::vector<double>& times, double speed, std::optional<double> reference) {
  if (times.size() < 2 || !(times.back() > times.front())) return {};
  const double mean = (times.back() - times.front()) * speed / static_cast<double>(times.size() - 1);
  std::vector<Spacing> spacings;
  for (std::size_t i = 1; i < times.size(); ++i)
    spacings.push_back({(times[i] - times[i - 1]) * speed, reference.value_or(mean)});
  return spacings;
}

double poisson_multiples(const SpacingLimits& limits, double reference) {
  return -std::expm1(-limits.multiples_below * reference);
}

double poisson_skips(const SpacingLimits& limits, double reference) {
  return std::exp(-limits.skips_above * reference);
}

}  // namespace vibrosow
