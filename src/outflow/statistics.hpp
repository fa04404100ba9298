#pragma once

#include <optional>
#include <vector>

namespace vibrosow {

/// Student's t interval of a mean: half width at 95 %, none for fewer than two values.
struct MeanWithInterval {
  double mean = 0;
  std::optional<double> half_width_95;
};

/// Student's t that leaves 2.5 % above it. Throws std::domain_error for degrees of freedom that are not positive.
double student_t_95(double degrees_of_freedom);

/// Mean and t(0.975, n - 1) s / sqrt(n). Not a number for no values.
MeanWithInterval mean_with_interval(const std::vector<double>& values);

/// A rate and the seeds that it was counted from: 0 where it is no count, or where none came.
struct CountedRate {
  double rate = 0;
  double seeds = 0;
};

/// Standard deviation that counting leaves open, however equal the rates are: a count is rounded to whole seeds, which
/// is 1 / sqrt(12) of a seed. In the rates' unit, of the run in which a seed gives the most.
double scatter_of_counting(const std::vector<CountedRate>& rates);

/// As `mean_with_interval`, with no less scatter than counting leaves open.
MeanWithInterval mean_of_rates(const std::vector<CountedRate>& rates);

/// Sample standard deviation (n - 1) over mean; none for fewer than two values or a mean of zero.
std::optional<double> coefficient_of_variation(const std::vector<double>& values);

}  // namespace vibrosow
