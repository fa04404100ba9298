#pragma once

#include <vector>

#include "selection/moments.hpp"

namespace vibrosow {

/// What many variances of equally many values say of variances in general: scaled inverse chi squared, fitted by the
/// moments of their logarithms (Smyth 2004, Statistical Applications in Genetics and Molecular Biology 3(1),
/// section 6.2).
struct VariancePrior {
  double degrees_of_freedom = 0;  // 0: nothing is known; infinite: all are equal
  double variance = 0;
};

/// `degrees_of_freedom`: of each of the variances. Variances of zero are left out; nothing is known by fewer than
/// three.
VariancePrior variance_prior(const std::vector<double>& variances, double degrees_of_freedom);

/// A mean as it is known, its variance shared with others'.
struct KnownMean {
  double mean = 0, variance = 0, degrees_of_freedom = 0;  // of one observation; infinite: it is known
  double count = 0;                                       // observations
  double error_squared() const { return variance / count; }
};

KnownMean known_mean(const Moments& moments, const VariancePrior& prior);

/// Probability that Student's t lies below `t`; normal where the degrees of freedom are infinite.
double probability_below(double t, double degrees_of_freedom);

/// Of a difference of two means (Welch).
double degrees_of_difference(const KnownMean& one, const KnownMean& other);

}  // namespace vibrosow
