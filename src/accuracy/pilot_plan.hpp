#pragma once

#include <optional>
#include <vector>

#include "accuracy/error_fit.hpp"

namespace vibrosow {

inline constexpr int most_replicates = 2000;

/// What is planned for: a run's half width at 95 % (percent of the limit), what runs of each setting cost (0: it cannot
/// be run) and of how many there are a rate already.
struct PilotBasis {
  const ErrorFit& fit;
  std::vector<double> costs{};
  std::vector<int> made{};
  double half_width_of_run;
};

/// What is wanted of a rate: one of the two.
struct PromiseGoal {
  std::optional<double> within_percent{};  // of the limit of step 0 and rigid grains, at 95 %, for the least work
  std::optional<double> cpu_time{};        // s, of all runs: the smallest error to be had for it
};

/// How many more pilots of each setting make the whole, these and the runs of the answer, cheapest, or its error
/// smallest. For each setting that might be chosen, the runs that narrow its band most for their cost are added one by
/// one, and the best place to stop is kept; the best of all settings is taken. All zero where nothing gets there.
std::vector<int> plan_pilots(const PilotBasis& basis, const PromiseGoal& goal);

/// For where that is nothing by the errors as they look now: of the settings that pilots and runs enough might yet show
/// to be within `percent`, the pilots that narrow most the band of the one that looks best, of a cost of `spent`. All
/// zero where there is none.
std::vector<int> plan_further_pilots(const PilotBasis& basis, double percent, double spent);

}  // namespace vibrosow
