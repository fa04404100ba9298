#include "calibration/repose_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vibrosow {
namespace {

constexpr int cells = 151;  // along each parameter

double square(double value) {
  return value * value;
}

/// How far measured figures are from a material's: squared distances in standard deviations, and the logarithm of the
/// variances, summed.
struct Misfit {
  double distance2 = 0, log_variance = 0;

  void add(double distance, double variance) {
    distance2 += distance * distance / variance;
    log_variance += std::log(variance);
  }
};

Misfit misfit(const AtlasMetrics& plane, const PlaneToSpace& to_space, const MeasuredBulk& measured) {
  Misfit sum;
  if (measured.angle) {
    const double expected = plane.angle.mean + to_space.angle_offset.mean;
    sum.add(*measured.angle - expected,
            square(measured.angle_error) + square(plane.angle.error) + square(angle_error_3d(to_space)));
  }
  if (measured.packing) {
    const double factor = to_space.packing_factor.mean;
    const double expected = plane.packing.mean * factor;
    sum.add(*measured.packing - expected, square(measured.packing_error) + square(plane.packing.error * factor) +
                                              square(expected * packing_error_3d(to_space)));
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

/// Weights of equal cells, together 1.
struct Posterior {
  std::vector<double> frictions, rollings;      // middles of cells
  std::vector<std::vector<double>> weights;     // [friction][rolling]
  std::vector<std::vector<double>> distances2;  // `Misfit`'s, likewise

  std::vector<double> of_friction() const {
    std::vector<double> sums;
    for (const auto& row : weights) sums.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    return sums;
  }
};

Posterior posterior_of(const ShippedAtlas& atlas, double aspect_ratio, const MeasuredBulk& measured) {
  Posterior posterior{middles(atlas.atlas.frictions()), middles(atlas.atlas.rolling_frictions()), {}, {}};
  double largest = -std::numeric_limits<double>::infinity();
  for (const double friction : posterior.frictions) {
    std::vector<double>& row = posterior.weights.emplace_back();
    std::vector<double>& distances2 = posterior.distances2.emplace_back();
    for (const double rolling : posterior.rollings) {
      const Misfit off = misfit(atlas.atlas.at(aspect_ratio, friction, rolling), atlas.to_space, measured);
      distances2.push_back(off.distance2);
      row.push_back(-0.5 * (off.distance2 + off.log_variance));
      largest = std::max(largest, row.back());
    }
  }
  double total = 0;
  for (auto& row : posterior.weights)
    for (double& weight : row) total += weight = std::exp(weight - largest);
  for (auto& row : posterior.weights)
    for (double& weight : row) weight /= total;
  return posterior;
}

/// The means themselves need not fit, where what fits is a bent band.
Rubbing nearest_fitting(const Posterior& posterior, const Moments& friction, const Moments& rolling) {
  constexpr double as_good = 0.01;  // 0.1 standard deviations of what was measured, squared
  double least_misfit = std::numeric_limits<double>::infinity();
  for (const auto& row : posterior.distances2) least_misfit = std::min(least_misfit, *std::ranges::min_element(row));
  Rubbing best{};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t j = 0; j < cells; ++j) {
      const double f = posterior.frictions[i], r = posterior.rollings[j];
      const double distance2 =
          square((f - friction.mean) / friction.deviation) + square((r - rolling.mean) / rolling.deviation);
      if (posterior.distances2[i][j] > least_misfit + as_good || distance2 >= nearest) continue;
      nearest = distance2;
      best = {f, r};
    }
  return best;
}

/// A number's binary digits mirrored at the point, in (0, 1): van der Corput's sequence.
double mirrored(int number) {
  double value = 0;
  for (double place = 0.5; number > 0; number /= 2, place /= 2) value += place * (number % 2);
  return value;
}

/// The cell that a value lies in.
std::size_t cell_of(const std::vector<double>& middles, double value) {
  const double cell = middles[1] - middles[0];
  const auto at = static_cast<std::size_t>(std::max(0.0, (value - middles[0]) / cell + 0.5));
  return std::min(at, middles.size() - 1);
}

}  // namespace

double angle_error_3d(const PlaneToSpace& to_space) {
  return to_space.angle_offset.scatter * std::sqrt(1 + 1.0 / to_space.materials);
}

double packing_error_3d(const PlaneToSpace& to_space) {
  return to_space.packing_factor.scatter / to_space.packing_factor.mean * std::sqrt(1 + 1.0 / to_space.materials);
}

Reachable reachable(const ShippedAtlas& atlas, double aspect_ratio) {
  const double infinity = std::numeric_limits<double>::infinity();
  Reachable range{infinity, -infinity, infinity, -infinity};
  for (const double friction : atlas.atlas.frictions())
    for (const double rolling : atlas.atlas.rolling_frictions()) {
      const AtlasMetrics plane = atlas.atlas.at(aspect_ratio, friction, rolling);
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
  const Posterior posterior = posterior_of(atlas, aspect_ratio, measured);
  const std::vector<double>&frictions = posterior.frictions, &rollings = posterior.rollings;
  std::vector<double> of_rolling(cells, 0);
  double product = 0;
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t j = 0; j < cells; ++j) {
      of_rolling[j] += posterior.weights[i][j];
      product += posterior.weights[i][j] * frictions[i] * rollings[j];
    }
  const std::vector<double> of_friction = posterior.of_friction();
  const Moments friction = moments(frictions, of_friction), rolling = moments(rollings, of_rolling);
  const double correlation = (product - friction.mean * rolling.mean) / (friction.deviation * rolling.deviation);
  return {band(frictions, of_friction), band(rollings, of_rolling), correlation,
          nearest_fitting(posterior, friction, rolling)};
}

std::vector<Rubbing> materials_of_band(const ShippedAtlas& atlas, double aspect_ratio, const MeasuredBulk& measured,
                                       int count) {
  const Posterior posterior = posterior_of(atlas, aspect_ratio, measured);
  const std::vector<double> of_friction = posterior.of_friction();
  std::vector<Rubbing> materials;
  for (int k = 0; k < count; ++k) {
    const double friction = quantile(posterior.frictions, of_friction, (k + 0.5) / count);
    std::vector<double> of_rolling = posterior.weights[cell_of(posterior.frictions, friction)];
    const double sum = std::accumulate(of_rolling.begin(), of_rolling.end(), 0.0);
    for (double& weight : of_rolling) weight /= sum;
    materials.push_back({friction, quantile(posterior.rollings, of_rolling, mirrored(k + 1))});
  }
  return materials;
}

}  // namespace vibrosow
