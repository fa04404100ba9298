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

/// Mean and t(0.975, n - 1) s / sqrt(n). Not a number for no values. `resolution`: what the values are rounded to,
/// which leaves a standard deviation of its 1 / sqrt(12) open, however equal they are.
MeanWithInterval mean_with_interval(const std::vector<double>& values, double resolution = 0);

/// What a rate changes by with one of the seeds that it was counted from; 0 of none.
inline double resolution_of(double rate, double seeds) {
  return seeds > 0 ? rate / seeds : 0;
}

/// Sample standard deviation (n - 1) over mean; none for fewer than two values or a mean of zero.
std::optional<double> coefficient_of_variation(const std::vector<double>& values);

}  // namespace vibrosow
