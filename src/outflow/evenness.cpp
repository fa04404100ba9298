#include "outflow/evenness.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numeric>

namespace vibrosow {
namespace {

double squared(double value) {
  return value * value;
}

using Counts = std::vector<std::int64_t>;

double total(const Counts& counts) {
  return static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
}

Counts summed(const std::vector<Counts>& counts) {
  Counts sums(counts.front().size(), 0);
  for (const Counts& one : counts)
    for (std::size_t hole = 0; hole < sums.size(); ++hole) sums[hole] += one.at(hole);
  return sums;
}

/// Scatter of the replicates about the common split among holes, of what counting gives: phi and its degrees of
/// freedom.
struct Scatter {
  double phi = 1;
  double degrees = 0;  // 0: nothing to tell it from
};

Scatter scatter_of(const std::vector<Counts>& counts, const Counts& sums) {
  double chi_squared = 0, replicates = 0, holes = 0;
  const double all = total(sums);
  for (const std::int64_t sum : sums) holes += sum > 0;
  for (const Counts& one : counts) {
    const double of_run = total(one);
    replicates += of_run > 0;
    for (std::size_t hole = 0; hole < sums.size(); ++hole) {
      const double expected = of_run * static_cast<double>(sums[hole]) / all;
      if (expected > 0) chi_squared += squared(static_cast<double>(one[hole]) - expected) / expected;
    }
  }
  const double degrees = (replicates - 1) * (holes - 1);
  return degrees > 0 ? Scatter{chi_squared / degrees, degrees} : Scatter{};
}

/// Probability of a dispersion below `x` at a noncentrality.
double below(double x, double noncentrality, double degrees, const Scatter& scatter) {
  namespace bm = boost::math;
  if (scatter.phi > 1 && scatter.degrees > 0) {
    const double f = x / scatter.phi / degrees;
    if (noncentrality == 0) return bm::cdf(bm::fisher_f(degrees, scatter.degrees), f);
    return bm::cdf(bm::non_central_f(degrees, scatter.degrees, noncentrality / scatter.phi), f);
  }
  if (noncentrality == 0) return bm::cdf(bm::chi_squared(degrees), x);
  return bm::cdf(bm::non_central_chi_squared(degrees, noncentrality), x);
}

/// The noncentrality at which a dispersion below `x` has this probability; 0 where it is less likely at any.
double noncentrality_at(double probability, double x, double degrees, const Scatter& scatter) {
  const auto excess = [&](double noncentrality) { return below(x, noncentrality, degrees, scatter) - probability; };
  if (excess(0) <= 0) return 0;
  double upper = std::max(1.0, x);
  while (excess(upper) > 0) upper *= 2;
  const auto [from, to] = boost::math::tools::bisect(excess, 0.0, upper, boost::math::tools::eps_tolerance<double>(30));
  return 0.5 * (from + to);
}

}  // namespace

std::optional<Evenness> evenness(const std::vector<Counts>& counts) {
  if (counts.empty() || counts.front().size() < 2) return std::nullopt;
  const Counts sums = summed(counts);
  const auto holes = static_cast<double>(sums.size());
  const double mean = total(sums) / holes, degrees = holes - 1;
  if (mean <= 0) return std::nullopt;
  double squares = 0;
  for (const std::int64_t sum : sums) squares += squared(static_cast<double>(sum) - mean);
  const Scatter scatter = scatter_of(counts, sums);
  const double x = squares / mean;
  const auto cv_of = [&](double noncentrality) { return std::sqrt(noncentrality / (mean * degrees)); };
  Evenness result;
  result.raw_cv = std::sqrt(squares / degrees) / mean;
  result.counting_cv = 1 / std::sqrt(mean);
  result.low = cv_of(noncentrality_at(0.975, x, degrees, scatter));
  result.high = std::max(cv_of(noncentrality_at(0.025, x, degrees, scatter)), result.raw_cv);
  if (result.low > 0) result.cv = cv_of(std::max(0.0, x - degrees * std::max(1.0, scatter.phi)));
  return result;
}

}  // namespace vibrosow
