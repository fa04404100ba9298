#pragma once

#include <cstddef>
#include <vector>

#include "design/sweep.hpp"

namespace vibrosow {

/// The discharge curves that a comparison needs of each run of a scene of the study; none for measured rates.
std::vector<CurveRequest> measured_curves(const Study& study, std::size_t scene);

/// Lays the measured outflow of a study beside the simulated: fits the scale where it is free, fills `comparison`, the
/// layouts' misfits and the holes' measured rates. Measured times beyond the end of the run are left out, and the
/// layout says so.
void compare_with_measured(StudyResult& result);

}  // namespace vibrosow
