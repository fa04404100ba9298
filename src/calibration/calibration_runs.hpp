#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_design.hpp"
#include "study/evaluate.hpp"

namespace vibrosow {

/// What is kept of one run of a design.
struct ReducedRun {
  std::string reason;          // why it counts for nothing; empty where it counts
  std::vector<double> values;  // of the series of its condition, in their order, SI and unscaled but for --scale depth:
                               // rates, or curves
  std::vector<Doubt> doubts{};  // of a run that counts, about what is fitted
};

/// Indices of the series that were measured under a condition.
std::vector<std::size_t> series_of(const CalibrationTask& task, const CalibrationDesign& design, std::size_t condition);

/// Of every run of a design, in its order. Runs that failed, passed nothing or clogged count for nothing. None where
/// one is missing. `kept`: gives the runs.
std::optional<std::vector<ReducedRun>> reduced_runs(const CalibrationTask& task, const CalibrationDesign& design,
                                                    const KeptRuns& kept);

/// Gives a reason to runs whose curve stands still from a time on after which the median run under the same condition
/// still has more than a tenth of its end to go.
void leave_out_clogged(const CalibrationTask& task, const CalibrationDesign& design, std::vector<ReducedRun>& runs);

}  // namespace vibrosow
