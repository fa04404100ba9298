#include "grains/size_distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numbers>

#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

using Kind = SizeDistribution::Kind;

/// Diameter (m) below which the fraction `part` of a normal or lognormal, cut at its least and most, lies. Boost's
/// arithmetic is kept in double, so that it does not depend on what a machine's long double is.
double cut_quantile(const SizeDistribution& sizes, double part) {
  using namespace boost::math::policies;
  using Normal = boost::math::normal_distribution<double, policy<promote_double<false>>>;
  const bool logarithmic = sizes.kind == Kind::lognormal;
  const auto [mean, deviation] = underlying_normal(sizes);
  const Normal normal(mean, deviation);
  const double below = cdf(normal, logarithmic ? std::log(sizes.least) : sizes.least);
  const double up_to = cdf(normal, logarithmic ? std::log(sizes.most) : sizes.most);
  const double probability = below + part * (up_to - below);
  if (probability <= 0) return sizes.least;
  if (probability >= 1) return sizes.most;
  const double x = quantile(normal, probability);
  return std::clamp(logarithmic ? std::exp(x) : x, sizes.least, sizes.most);
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

}  // namespace vibrosow
