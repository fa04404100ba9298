#include "selection/rinott.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

/// Chi squared as points and weights: Gauss' rule over the square root, which is nearly normal.
struct Points {
  std::vector<double> value, weight;
};

Points points_of(double degrees_of_freedom) {
  const double from = std::sqrt(chi_squared_quantile(degrees_of_freedom, 1e-14)),
               to = std::sqrt(chi_squared_quantile_above(degrees_of_freedom, 1e-14));
  using Rule = boost::math::quadrature::gauss<double, 60>;
  Points points;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const double sign : {-1.0, 1.0}) {
      const double root = (from + to) / 2 + sign * Rule::abscissa()[i] * (to - from) / 2;
      points.value.push_back(root * root);
      points.weight.push_back(Rule::weights()[i] * (to - from) / 2 *
                              chi_squared_density(degrees_of_freedom, root * root) * 2 * root);
    }
  return points;
}

double probability_of_least(const Points& points, std::size_t systems, double nu, double h) {
  double whole = 0;
  for (std::size_t y = 0; y < points.value.size(); ++y) {
    double better = 0;
    for (std::size_t x = 0; x < points.value.size(); ++x)
      better += points.weight[x] * normal_below(h / std::sqrt(nu * (1 / points.value[x] + 1 / points.value[y])));
    whole += points.weight[y] * std::pow(better, static_cast<double>(systems - 1));
  }
  return whole;
}

}  // namespace

double rinott_h(std::size_t systems, int first, double confidence) {
  if (systems < 2 || first < 2) throw std::invalid_argument("Rinott's procedure is for two systems and more");
  if (!(confidence > 1.0 / static_cast<double>(systems) && confidence < 1))
    throw std::invalid_argument("a confidence is above chance and below 1");
  const double nu = first - 1.0;
  const Points points = points_of(nu);
  const auto lacking = [&](double h) { return probability_of_least(points, systems, nu, h) - confidence; };
  double high = 4;
  while (lacking(high) < 0) high *= 2;
  std::uintmax_t steps = 100;
  const auto [below, above] =
      boost::math::tools::toms748_solve(lacking, 0.0, high, boost::math::tools::eps_tolerance<double>(30), steps);
  return (below + above) / 2;
}

double rinott_observations(double h, double variance, double margin, int first) {
  return std::max<double>(first, std::ceil(h * h * variance / (margin * margin)));
}

}  // namespace vibrosow
