#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace vibrosow {

/// How far the rates of holes differ: higher is worse. Of the raw rates: holes of unequal widths are uneven by intent
/// and count as uneven. All are coefficients of variation (fractions).
struct Unevenness {
  double chance_cv = 0;      // of the counts over all parts together, what holes of equal rates would show
  std::optional<double> cv;  // of the rates, chance taken out; none: equal holes would show as much in 1 of 20 studies
  double low = 0, high = 0;  // its 95 % interval; where it is none, it may be up to `high`
};

/// From the seeds of each hole, `counts[part][hole]`, of parts that are independent and equally long: replicates, or
/// blocks of one run. None for fewer than two parts or holes, or no seeds.
///
/// Method: a two-way layout. Swings that all holes share fall out, and the chance of a count is the interaction of
/// holes and parts, sigma2 = SSW / ((R - 1) (H - 1)), whatever it is: seeds come far more regularly than independent
/// ones would. It is not less than 1/6, the variance of a clockwork flow that is counted in whole seeds. A difference
/// is resolved by the F test at 5 %. The interval's ends are where the distribution function of the noncentral chi
/// squared of SSB / sigma2, with noncentrality R (H - 1) (cv mean)^2 / sigma2, is 0.975 and 0.025 in the mean over
/// sigma2 = SSW / chi squared. Where the holes differ less than chance lets them (F < 1), the upper end is that of
/// F = 1.
std::optional<Unevenness> unevenness(const std::vector<std::vector<std::int64_t>>& counts);

/// The coefficient of variation of the holes' counts as they are, chance included; none for fewer than two holes or no
/// seeds.
std::optional<double> raw_cv(const std::vector<std::int64_t>& counts);

/// Hole by hole, the counts of all parts together.
std::vector<std::int64_t> sum_of_parts(const std::vector<std::vector<std::int64_t>>& counts);

/// counts[hole][part] from counts[part][hole], and back. All of the lists are equally long.
std::vector<std::vector<std::int64_t>> transposed(const std::vector<std::vector<std::int64_t>>& counts);

}  // namespace vibrosow
