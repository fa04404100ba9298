#include "selection/known_mean.hpp"

#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/polygamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

/// Smyth 2004, appendix: Newton's method on 1 / trigamma, which is nearly linear.
double inverse_trigamma(double wanted) {
  if (wanted > 1e7) return 1 / std::sqrt(wanted);
  if (wanted < 1e-6) return 1 / wanted;
  double x = 0.5 + 1 / wanted;
  for (int i = 0; i < 50; ++i) {
    const double trigamma = boost::math::trigamma(x);
    const double step = trigamma * (1 - trigamma / wanted) / boost::math::polygamma(2, x);
    x += step;
    if (-step < 1e-10 * x) break;
  }
  return x;
}

}  // namespace

VariancePrior variance_prior(const std::vector<double>& variances, double degrees_of_freedom) {
  using boost::math::digamma;
  using boost::math::trigamma;
  const double half = degrees_of_freedom / 2;
  Moments logarithms;
  for (const double variance : variances)
    if (variance > 0) logarithms.add(std::log(variance) - digamma(half) + std::log(half));
  if (logarithms.count() < 3) return {};
  const double beyond_chance = logarithms.variance() - trigamma(half);
  if (beyond_chance <= 0) return {HUGE_VAL, std::exp(logarithms.mean())};
  const double half_prior = inverse_trigamma(beyond_chance);
  return {2 * half_prior, std::exp(logarithms.mean() + digamma(half_prior) - std::log(half_prior))};
}

KnownMean known_mean(const Moments& moments, const VariancePrior& prior) {
  KnownMean known{moments.mean(), 0, 0, static_cast<double>(moments.count())};
  if (moments.count() == 0) return known;
  const double own = moments.count() - 1.0;
  known.degrees_of_freedom = own + prior.degrees_of_freedom;
  known.variance =
      std::isinf(prior.degrees_of_freedom) ? prior.variance
      : known.degrees_of_freedom > 0
          ? (own * moments.variance() + prior.degrees_of_freedom * prior.variance) / known.degrees_of_freedom
          : 0;
  return known;
}

double probability_below(double t, double degrees_of_freedom) {
  constexpr double nearly_normal = 1e6;
  if (degrees_of_freedom > nearly_normal) return normal_below(t);
  return students_t_below(degrees_of_freedom, t);
}

double degrees_of_difference(const KnownMean& one, const KnownMean& other) {
  const double a = one.error_squared(), b = other.error_squared();
  return (a + b) * (a + b) / (a * a / one.degrees_of_freedom + b * b / other.degrees_of_freedom);
}

}  // namespace vibrosow
