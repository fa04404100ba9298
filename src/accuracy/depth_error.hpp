#pragma once

#include <optional>
#include <vector>

#include "accuracy/error_fit.hpp"
#include "outflow/doubts.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// What standing for a tray by a plane does to its rate.
struct DepthError {
  MeanWithInterval plane, space;  // kg/s of the tray: the plane's slice times its slices; balls
  RateError error;                // plane less space, of space; its band of both intervals, as independent
  std::vector<CountedDoubt> doubts_2d{}, doubts_3d{};  // of the runs
};

/// From so many runs of each, of the scenes' own numerics; both have a `tray.depth`. None where a run was cut short or
/// left the model, or nothing flows in one of the two. Throws InputError where one of the two cannot be run, and
/// std::invalid_argument for fewer than two runs.
std::optional<DepthError> measure_depth_error(const Scene& plane, const Scene& space, int replicates,
                                              const Simulator& simulator, const SweepOptions& options);

}  // namespace vibrosow
