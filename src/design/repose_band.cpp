#include "design/repose_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vibrosow {
namespace {

constexpr int cells = 150;  // along each parameter

double square(double value) {
  return value * value;
}

/// -1/2 of the squared distance in standard deviations, and their logarithm.
double log_normal(double distance, double variance) {
  return -0.5 * (distance * distance / variance + std::log(variance));
}

double log_likelihood(const AtlasFigures& plane, const PlaneToSpace& to_space, const MeasuredBulk& measured) {
  double sum = 0;
  if (measured.angle) {
    const double expected = plane.angle.mean + to_space.angle_offset.mean;
    sum += log_normal(*measured.angle - expected, square(measured.angle_error) + square(plane.angle.error) +
                                                      square(angle_error_in_space(to_space)));
  }
  if (measured.packing) {
    const double factor = to_space.packing_factor.mean;
    const double expected = plane.packing.mean * factor;
    sum +=
        log_normal(*measured.packing - expected, square(measured.packing_error) + square(plane.packing.error * factor) +
                                                     square(expected * packing_error_in_space(to_space)));
  }
  return sum;
}

/// Middles of equal cells over an axis.
std::vector<double> middles(const std::vector<double>& axis) {
  std::vector<double> values(cells);
  for (int k = 0; k < cells; ++k)
    values[static_cast<std::size_t>(k)] = axis.front() + (k + 0.5) / cells * (axis.back() - axis.front());
  return values;
}

/// Where the cumulative share of the weights, spread evenly over each cell, reaches `share`.
double quantile(const std::vector<double>& values, const std::vector<double>& weights, double share) {
  const double cell = values[1] - values[0];
  double below = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (below + weights[k] >= share) return values[k] + cell * ((share - below) / weights[k] - 0.5);
    below += weights[k];
  }
  return values.back() + 0.5 * cell;
}

struct Moments {
  double mean, deviation;
};

Moments moments(const std::vector<double>& values, const std::vector<double>& weights) {
  double mean = 0, variance = 0;
  for (std::size_t k = 0; k < values.size(); ++k) mean += weights[k] * values[k];
  for (std::size_t k = 0; k < values.size(); ++k) variance += weights[k] * square(values[k] - mean);
  return {mean, std::sqrt(variance)};
}

ParameterBand band(const std::vector<double>& values, const std::vector<double>& weights) {
  const std::vector<double> prior(values.size(), 1.0 / static_cast<double>(values.size()));
  const Moments known = moments(values, weights);
  return {known.mean, quantile(values, weights, 0.025), quantile(values, weights, 0.975),
          1 - known.deviation / moments(values, prior).deviation};
}

}  // namespace

double angle_error_in_space(const PlaneToSpace& to_space) {
  return to_space.angle_offset.scatter * std::sqrt(1 + 1.0 / to_space.materials);
}

double packing_error_in_space(const PlaneToSpace& to_space) {
  return to_space.packing_factor.scatter / to_space.packing_factor.mean * std::sqrt(1 + 1.0 / to_space.materials);
}

Reachable reachable(const ShippedAtlas& atlas, double aspect_ratio) {
  const double infinity = std::numeric_limits<double>::infinity();
  Reachable range{infinity, -infinity, infinity, -infinity};
  for (const double friction : atlas.atlas.frictions())
    for (const double rolling : atlas.atlas.rolling_frictions()) {
      const AtlasFigures plane = atlas.atlas.at(aspect_ratio, friction, rolling);
      const double angle = plane.angle.mean + atlas.to_space.angle_offset.mean;
      const double packing = plane.packing.mean * atlas.to_space.packing_factor.mean;
      range.least_angle = std::min(range.least_angle, angle);
      range.most_angle = std::max(range.most_angle, angle);
      range.least_packing = std::min(range.least_packing, packing);
      range.most_packing = std::max(range.most_packing, packing);
    }
  return range;
}

ReposeBand repose_band(const ShippedAtlas& atlas, double aspect_ratio, const MeasuredBulk& measured) {
  const std::vector<double> frictions = middles(atlas.atlas.frictions());
  const std::vector<double> rollings = middles(atlas.atlas.rolling_frictions());
  std::vector<double> logs;
  for (const double friction : frictions)
    for (const double rolling : rollings)
      logs.push_back(log_likelihood(atlas.atlas.at(aspect_ratio, friction, rolling), atlas.to_space, measured));
  const double largest = *std::ranges::max_element(logs);
  double total = 0;
  for (double& value : logs) total += value = std::exp(value - largest);
  std::vector<double> of_friction(cells, 0), of_rolling(cells, 0);
  double product = 0;
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t j = 0; j < cells; ++j) {
      const double weight = logs[i * cells + j] / total;
      of_friction[i] += weight;
      of_rolling[j] += weight;
      product += weight * frictions[i] * rollings[j];
    }
  const Moments friction = moments(frictions, of_friction), rolling = moments(rollings, of_rolling);
  const double correlation = (product - friction.mean * rolling.mean) / (friction.deviation * rolling.deviation);
  return {band(frictions, of_friction), band(rollings, of_rolling), correlation};
}

}  // namespace vibrosow
