#pragma once

#include <string>

#include "report/calibration_report.hpp"
#include "report/columns.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The page's numbers and texts (page_text): the fitted values with what is doubtful, every measured value with its
/// prediction, and points of the posterior. `scene`: that was simulated, for its title.
std::string calibration_page_data(const CalibrationAnswer& answer, const Scene& scene);

/// What report.html holds.
FileText calibration_page_text();

}  // namespace vibrosow
