#pragma once

#include <cstddef>
#include <vector>

#include "study/sweep.hpp"

namespace vibrosow {

/// The discharge curves that a comparison needs of each run of a scene of the study; none for measured rates.
std::vector<CurveRequest> measured_curves(const Study& study, std::size_t scene);

/// Throws InputError where a series cannot be of `scene`, which the message calls `whose`: it has not that hole or lot,
/// or no fill that empties, of which a share could have left, or its run ends before the series does.
void check_measurable(const MeasuredPart& part, const MeasuredSeries& series, const Scene& scene,
                      const std::string& whose);

/// Of one measured series the discharge curve that is needed of a run of `scene`, for `simulated_values`.
CurveRequest curve_request(const MeasuredPart& part, const MeasuredSeries& series, const Scene& scene);

/// What a finished run of `scene` gives in the place of a measured series, SI and unscaled: its rate, or its curve
/// since the curve's zero, at the series' times. The run was evaluated with `curve_request`. Throws std::logic_error
/// for a hole or lot that the scene has not.
std::vector<double> simulated_values(const Evaluation& run, const MeasuredPart& part, const MeasuredSeries& series,
                                     const Scene& scene);

/// Lays the measured outflow of a study beside the simulated: fits the scale where it is free, fills `comparison`, the
/// layouts' misfits and the holes' measured rates.
void compare_with_measured(StudyResult& result);

}  // namespace vibrosow
