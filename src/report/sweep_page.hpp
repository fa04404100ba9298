#pragma once

#include <string>

#include "design/sweep.hpp"
#include "report/columns.hpp"

namespace vibrosow {

/// The page's numbers and texts (page_text): the layouts with their figures, and how each is built.
std::string sweep_page_data(const StudyResult& result);

/// report.html of a sweep (filled_page).
std::string sweep_page(const std::string& page_template, const StudyResult& result);

/// What the file holds.
FileText sweep_page_text();

}  // namespace vibrosow
