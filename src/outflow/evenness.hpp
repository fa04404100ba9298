#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace vibrosow {

/// How far the rates of holes differ. Of the raw rates: holes of unequal widths are uneven by intent and count as
/// uneven. All are coefficients of variation (fractions).
struct Evenness {
  double raw_cv = 0;         // of the counts as they are
  double counting_cv = 0;    // what counting alone gives, 1 / sqrt(mean count): independent seeds
  std::optional<double> cv;  // of the rates, without chance; none: below what this many seeds resolve
  double low = 0, high = 0;  // its 95 % interval; low is 0 where it is not resolved
};

/// From the seeds of each hole over the same time, of one run or of several replicates (`counts[replicate][hole]`),
/// which are summed hole by hole. None for fewer than two holes or no seeds.
///
/// Method: were the summed counts N_j Poisson about M (1 + d_j), X = sum (N_j - mean)^2 / mean would be noncentral chi
/// squared with H - 1 degrees of freedom and noncentrality M (H - 1) cv^2, which gives the interval without any
/// assumption of large numbers. Where replicates scatter more than counting (Pearson's chi squared of the table of
/// holes and replicates over its degrees of freedom, phi > 1), X / phi is noncentral F instead. Seeds that come more
/// regularly than by chance make the interval wider than it need be, never narrower: came they like clockwork, the raw
/// CV would be that of the rates, so `high` is not below it.
std::optional<Evenness> evenness(const std::vector<std::vector<std::int64_t>>& counts);

}  // namespace vibrosow
