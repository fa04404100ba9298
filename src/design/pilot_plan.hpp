#pragma once

#include <optional>
#include <vector>

#include "design/error_fit.hpp"

namespace vibrosow {

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

}  // namespace vibrosow
