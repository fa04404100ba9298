#pragma once

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

/// What may be wanted of a plan: a bound of the error (percent), or a sum that is not to be spent.
struct PilotGoal {
  std::optional<double> within_percent{};
  std::optional<double> budget{};
};

/// How many more pilots of each setting make the whole, these and the runs of the answer, cheapest, or its error
/// smallest. For each setting that might be chosen, the runs that narrow its band most for their cost are added one by
/// one, and the best place to stop is kept; the best of all settings is taken. All zero where nothing gets there.
std::vector<int> plan_pilots(const PilotBasis& basis, const PilotGoal& goal);

}  // namespace vibrosow
