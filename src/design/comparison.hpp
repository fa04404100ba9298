#pragma once

#include "design/sweep.hpp"

namespace vibrosow {

/// Lays the measured outflow of a study beside the simulated: fits the scale where it is free, fills `comparison`, the
/// layouts' misfits and the holes' measured rates. Measured times beyond the end of the run are left out, and the
/// layout says so.
void compare_with_measured(StudyResult& result);

}  // namespace vibrosow
