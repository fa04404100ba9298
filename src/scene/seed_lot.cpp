#include "scene/seed_lot.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/clump_body.hpp"
#include "scene/clump_shape.hpp"

#include "portable_math/functions.hpp"

namespace vibrosow {
namespace {

using Kind = SizeDistribution::Kind;

/// Of the largest disc or ball of a seed of the lot's diameter, m.
double disc_diameter(const SeedLot& lot) {
  if (lot.shape != Shape::clump) return lot.diameter;
  double radius = 0;
  for (const ClumpDisc& disc : lot.discs) radius = std::max(radius, disc.radius);
  return 2 * radius;
}

/// (x / unit)^power
double share_in_moment(double x, double unit, int power) {
  return portable_math::pow(x / unit, power);
}

/// E[(x / unit)^power] of a normal or lognormal cut at its least and most.
double cut_moment(const SizeDistribution& sizes, double unit, int power) {
  constexpr double far = 12;         // deviations from the mean; beyond lies no weight that a double could hold
  constexpr unsigned halvings = 12;  // at most
  constexpr double tolerance = 1e-13;
  const bool logarithmic = sizes.kind == Kind::lognormal;
  const UnderlyingNormal normal = underlying_normal(sizes);
  const auto deviations = [&](double x) {
    return ((logarithmic ? portable_math::log(x) : x) - normal.mean) / normal.deviation;
  };
  const double from = std::max(-far, deviations(sizes.least)), to = std::min(far, deviations(sizes.most));
  const auto weighted = [&](int exponent) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        [&](double z) {
          const double x = normal.mean + normal.deviation * z;
          return portable_math::exp(-0.5 * z * z) *
                 share_in_moment(logarithmic ? portable_math::exp(x) : x, unit, exponent);
        },
        from, to, halvings, tolerance);
  };
  return weighted(power) / weighted(0);
}

}  // namespace

UnderlyingNormal underlying_normal(const SizeDistribution& sizes) {
  if (sizes.kind != Kind::lognormal) return {sizes.mean, sizes.deviation};
  const double relative = sizes.deviation / sizes.mean;
  const double variance = portable_math::log1p(relative * relative);
  return {portable_math::log(sizes.mean) - 0.5 * variance, std::sqrt(variance)};
}

void scale(SizeDistribution& sizes, double factor) {
  for (double* length : {&sizes.mean, &sizes.deviation, &sizes.least, &sizes.most}) *length *= factor;
  for (double& diameter : sizes.diameter) diameter *= factor;
}

double least_size(const SeedLot& lot) {
  const SizeDistribution& sizes = lot.sizes;
  if (sizes.kind == Kind::single) return 1;
  if (sizes.kind == Kind::table) return *std::min_element(sizes.diameter.begin(), sizes.diameter.end()) / lot.diameter;
  return sizes.least / lot.diameter;
}

double most_size(const SeedLot& lot) {
  const SizeDistribution& sizes = lot.sizes;
  if (sizes.kind == Kind::single) return 1;
  if (sizes.kind == Kind::table) return *std::max_element(sizes.diameter.begin(), sizes.diameter.end()) / lot.diameter;
  return sizes.most / lot.diameter;
}

double size_moment(const SeedLot& lot, int power) {
  const SizeDistribution& sizes = lot.sizes;
  if (sizes.kind == Kind::single) return 1;
  if (sizes.kind == Kind::table) {
    double moment = 0;
    for (std::size_t k = 0; k < sizes.diameter.size(); ++k)
      moment += sizes.fraction[k] * share_in_moment(sizes.diameter[k], lot.diameter, power);
    return moment;
  }
  if (sizes.kind == Kind::uniform) {
    double moment = 0;  // (b^(n+1) - a^(n+1)) / ((n + 1) (b - a)), divided out
    for (int k = 0; k <= power; ++k)
      moment += share_in_moment(sizes.least, lot.diameter, k) * share_in_moment(sizes.most, lot.diameter, power - k);
    return moment / (power + 1);
  }
  return cut_moment(sizes, lot.diameter, power);
}

bool is_solid_clump(const SeedLot& lot) {
  return lot.shape == Shape::clump && lot.gyration2_x > 0 && lot.gyration2_y > 0;
}

bool has_clumps(const std::vector<SeedLot>& lots) {
  return std::ranges::any_of(lots, [](const SeedLot& lot) { return lot.shape == Shape::clump; });
}

int mass_power(const SeedLot& lot) {
  return lot.shape == Shape::disc ? 2 : 3;
}

double mean_mass(const SeedLot& lot) {
  return lot.mass * size_moment(lot, mass_power(lot));
}

std::vector<SeedSizes> sizes_of(const std::vector<SeedLot>& lots) {
  std::vector<SeedSizes> sizes;
  for (const SeedLot& lot : lots)
    sizes.push_back({least_size(lot), most_size(lot), size_moment(lot, 1), mean_mass(lot)});
  return sizes;
}

double clump_volume(const SeedLot& lot) {
  return is_solid_clump(lot) ? body_of_balls(lot.discs).volume : volume_of_balls(lot.discs);
}

std::optional<double> seed_density(const SeedLot& lot) {
  if (lot.shape == Shape::disc) return std::nullopt;
  if (lot.shape == Shape::clump) return lot.mass / clump_volume(lot);
  return lot.mass / (std::numbers::pi / 6 * portable_math::pow(lot.diameter, 3));
}

double mean_thickness(const SeedLot& lot) {
  return disc_diameter(lot) * size_moment(lot, 1);
}

double largest_diameter(const std::vector<SeedLot>& lots) {
  double largest = 0;
  for (const SeedLot& lot : lots) largest = std::max(largest, most_size(lot) * lot.diameter);
  return largest;
}

double largest_disc_diameter(const std::vector<SeedLot>& lots) {
  double largest = 0;
  for (const SeedLot& lot : lots) largest = std::max(largest, most_size(lot) * disc_diameter(lot));
  return largest;
}

double smallest_radius(const std::vector<SeedLot>& lots) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const SeedLot& lot : lots) {
    double radius = 0.5 * lot.diameter;
    for (const ClumpDisc& disc : lot.discs) radius = std::min(radius, disc.radius);
    smallest = std::min(smallest, least_size(lot) * radius);
  }
  return smallest;
}

}  // namespace vibrosow
