#include "grains/size_distribution.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "portable_math/functions.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

using Kind = SizeDistribution::Kind;

/// The fraction of a normal distribution below `deviations` from its mean.
double normal_fraction(double deviations) {
  return 0.5 * portable_math::erfc(-deviations / std::numbers::sqrt2);
}

/// Diameter (m) below which the fraction `part` of a normal or lognormal, cut at its least and most, lies.
double cut_quantile(const SizeDistribution& sizes, double part) {
  const bool logarithmic = sizes.kind == Kind::lognormal;
  const UnderlyingNormal normal = underlying_normal(sizes);
  const double mean = normal.mean, deviation = normal.deviation;
  constexpr double far = 12;  // deviations from the mean; beyond lies no weight that a double could hold
  const auto deviations = [&](double x) { return ((logarithmic ? portable_math::log(x) : x) - mean) / deviation; };
  const double from = std::max(-far, deviations(sizes.least)), to = std::min(far, deviations(sizes.most));
  const double below = normal_fraction(from), up_to = normal_fraction(to);
  const double fraction = below + part * (up_to - below);
  if (fraction <= below) return sizes.least;
  if (fraction >= up_to) return sizes.most;
  std::uintmax_t iterations = 200;
  const auto [low, high] = boost::math::tools::toms748_solve([&](double z) { return normal_fraction(z) - fraction; },
                                                             from, to, below - fraction, up_to - fraction,
                                                             boost::math::tools::eps_tolerance<double>(52), iterations);
  const double x = mean + deviation * 0.5 * (low + high);
  return std::clamp(logarithmic ? portable_math::exp(x) : x, sizes.least, sizes.most);
}

double table_quantile(const SizeDistribution& sizes, double part) {
  for (std::size_t k = 0; k + 1 < sizes.fraction.size(); ++k) {
    part -= sizes.fraction[k];
    if (part < 0) return sizes.diameter[k];
  }
  return sizes.diameter.back();
}

}  // namespace

double draw_size(const SeedLot& lot, Random& random) {
  const SizeDistribution& sizes = lot.sizes;
  if (sizes.kind == Kind::single) return 1;
  const double part = random.uniform();
  if (sizes.kind == Kind::uniform) return (sizes.least + part * (sizes.most - sizes.least)) / lot.diameter;
  return (sizes.kind == Kind::table ? table_quantile(sizes, part) : cut_quantile(sizes, part)) / lot.diameter;
}

double draw_angle(const SeedLot& lot, Random& random) {
  return lot.shape == Shape::clump ? random.uniform(0, 2 * std::numbers::pi) : 0;
}

Orientation draw_orientation(Random& random) {
  const double part = random.uniform(), first = std::sqrt(1 - part), second = std::sqrt(part);
  const auto a = portable_math::sine_cosine(random.uniform(0, 2 * std::numbers::pi));
  const auto b = portable_math::sine_cosine(random.uniform(0, 2 * std::numbers::pi));
  return of_unit_length({second * b.cosine, first * a.sine, first * a.cosine, second * b.sine});
}

Turn draw_turn(const SeedLot& lot, Random& random) {
  if (is_solid_clump(lot)) return {0, draw_orientation(random)};
  return {draw_angle(lot, random)};
}

}  // namespace vibrosow
