#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_design.hpp"
#include "outflow/doubts.hpp"

namespace vibrosow {

/// What a bench has: settings that can be changed, and time.
struct BenchLimits {
  double time = 1800;    // s, for all of it
  double handling = 60;  // s, for each reading besides its catching: to set, fill and weigh
  double noise = 0.02;   // relative standard deviation of a reading beside the chance of the flow
};

/// A condition that can be set, and what a reading under it would say.
struct BenchCandidate {
  std::vector<Condition> conditions;
  double mass_rate = 0;        // kg/s, of the plane slice or in 3D of the tray: geometric mean over the keys' ranges
  double chance = 0;           // relative standard deviation of one reading; of the flow's that of all runs together
  std::optional<int> place{};  // in the order in which it was chosen, 1..; none: it was not
};

/// Which conditions to measure, how long and how often.
struct BenchPlan {
  std::vector<BenchCandidate> candidates;
  double catch_time = 0;            // s, of each reading
  int repeats = 0;                  // of each condition
  std::vector<double> contraction;  // that is expected, of CalibrationTask::keys; without what calibrate holds out
  bool whole_rates = true;          // false: rates are known up to a factor
  std::vector<SharedDoubt> doubts;  // what speaks against the runs that it was made from
  int readings() const;
  std::vector<const BenchCandidate*> chosen() const;  // in their order
};

/// A measured table without values, to be measured: every combination of three values of each setting, of two where
/// there are more than two settings, rounded to three digits. Throws InputError for a range that has no two of them.
MeasuredTable bench_candidates(const std::vector<KeyRange>& settings);

/// Chooses the conditions one after the other, each as the one that adds most to the expected logarithm of the
/// determinant of the keys' information (Bayesian D-optimality, Chaloner & Verdinelli 1995), over 64 Sobol points of
/// their ranges, with one Gaussian process over keys and settings fitted to the runs of `design` (design_bench), which
/// was made for `bench_candidates`. A condition under which fewer than half of the runs let anything through is left
/// out. A reading is as telling as its own chance, and that of the runs which calibrate will set beside it, allow.
/// Where the task's scale is free, the factor is one more unknown. Each condition is read three times, twice where that
/// leaves too few; readings catch a thousand seeds or more, 10 to 120 s, and at most half of what a fill that is not
/// kept up holds. None where a run is missing. Throws InputError where too few runs can be used, or the time is too
/// short.
std::optional<BenchPlan> plan_bench(const CalibrationTask& task, const CalibrationDesign& design,
                                    const BenchLimits& limits, const KeptRuns& kept);

}  // namespace vibrosow
