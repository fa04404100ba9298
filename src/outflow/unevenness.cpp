#include "outflow/unevenness.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <utility>

#include "outflow/statistics.hpp"

namespace vibrosow {
namespace {

namespace bm = boost::math;
using Counts = std::vector<std::int64_t>;

double squared(double value) {
  return value * value;
}

/// Sums of squares of the two-way layout; `mean` is of a hole in a part.
struct TwoWay {
  double parts = 0, holes = 0, mean = 0;
  double between = 0, within = 0;  // of holes, and of the interaction

  double degrees_between() const { return holes - 1; }
  double degrees_within() const { return (parts - 1) * (holes - 1); }
  /// Of the chance of a count.
  double variance() const { return within / degrees_within(); }
  double f() const { return between / degrees_between() / variance(); }
};

TwoWay two_way(const std::vector<Counts>& counts) {
  constexpr double least_variance = 1.0 / 6;
  TwoWay of;
  of.parts = static_cast<double>(counts.size()), of.holes = static_cast<double>(counts.front().size());
  std::vector<double> of_hole(counts.front().size(), 0.0);
  double total = 0, within = 0;
  for (const Counts& part : counts)
    for (std::size_t hole = 0; hole < of_hole.size(); ++hole) {
      const auto count = static_cast<double>(part.at(hole));
      of_hole[hole] += count / of.parts, total += count;
    }
  of.mean = total / of.parts / of.holes;
  for (const double mean : of_hole) of.between += of.parts * squared(mean - of.mean);
  for (const Counts& part : counts) {
    double of_part = 0;
    for (const std::int64_t count : part) of_part += static_cast<double>(count) / of.holes;
    for (std::size_t hole = 0; hole < of_hole.size(); ++hole)
      within += squared(static_cast<double>(part[hole]) - of_hole[hole] - of_part + of.mean);
  }
  of.within = std::max(within, least_variance * of.degrees_within());
  return of;
}

/// Probability that holes of this cv differ by no more than `between` says, in the mean over what the chance may be.
double below(double between, double cv, const TwoWay& of) {
  const double noncentrality = of.parts * of.degrees_between() * squared(cv * of.mean);  // times the variance
  const bm::chi_squared chance(of.degrees_within());
  const auto at = [&](double probability) {
    const double over_variance = quantile(chance, probability) / of.within;
    const double x = between * over_variance, lambda = noncentrality * over_variance;
    if (lambda == 0) return cdf(bm::chi_squared(of.degrees_between()), x);
    return cdf(bm::non_central_chi_squared(of.degrees_between(), lambda), x);
  };
  return bm::quadrature::gauss<double, 30>::integrate(at, 0.0, 1.0);
}

/// The cv at which so small a difference has this probability; 0 where it is less likely at any.
double cv_at(double probability, double between, const TwoWay& of) {
  const auto excess = [&](double cv) { return below(between, cv, of) - probability; };
  const double at_none = excess(0);
  if (at_none <= 0) return 0;
  double low = 0, high = std::sqrt(2 * between / of.parts / of.degrees_between()) / of.mean;
  double at_low = at_none, at_high = excess(high);
  while (at_high > 0) low = high, at_low = at_high, high *= 2, at_high = excess(high);
  if (at_high == 0) return high;
  std::uintmax_t steps = 60;
  const auto [from, to] =
      bm::tools::toms748_solve(excess, low, high, at_low, at_high, bm::tools::eps_tolerance<double>(24), steps);
  return 0.5 * (from + to);
}

}  // namespace

std::optional<Unevenness> unevenness(const std::vector<Counts>& counts) {
  if (counts.size() < 2 || counts.front().size() < 2) return std::nullopt;
  const TwoWay of = two_way(counts);
  if (of.mean <= 0) return std::nullopt;
  const double degrees = of.degrees_between();
  const auto cv_of = [&](double sum) { return std::sqrt(std::max(0.0, sum) / of.parts / degrees) / of.mean; };
  Unevenness result;
  result.chance_cv = cv_of(degrees * of.variance());
  const bm::fisher_f equal_holes(degrees, of.degrees_within());
  if (cdf(complement(equal_holes, of.f())) < 0.05) result.cv = cv_of(of.between - degrees * of.variance());
  result.low = cv_at(0.975, of.between, of);
  result.high = cv_at(0.025, std::max(of.between, degrees * of.variance()), of);
  return result;
}

std::optional<double> raw_cv(const Counts& counts) {
  return coefficient_of_variation(std::vector<double>(counts.begin(), counts.end()));
}

Counts sum_of_parts(const std::vector<Counts>& counts) {
  Counts sums(counts.front().size(), 0);
  for (const Counts& part : counts)
    for (std::size_t hole = 0; hole < sums.size(); ++hole) sums[hole] += part.at(hole);
  return sums;
}

std::vector<Counts> transposed(const std::vector<Counts>& counts) {
  std::vector<Counts> other(counts.empty() ? 0 : counts.front().size(), Counts(counts.size()));
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (std::size_t j = 0; j < other.size(); ++j) other[j][i] = counts[i].at(j);
  return other;
}

}  // namespace vibrosow
