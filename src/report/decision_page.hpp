#pragma once

#include <string>

#include "report/columns.hpp"
#include "report/decision_report.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {

/// The page's numbers and texts (page_text): the answer, what was asked, the layouts with their standings, and how each
/// is built.
std::string decision_page_data(const DecisionReport& report, const SweepTiming& timing);

/// report.html of a decision (filled_page). `timing`: of the runs that were made for it just now.
std::string decision_page(const std::string& page_template, const DecisionReport& report, const SweepTiming& timing);

/// What the file holds.
FileText decision_page_text();

}  // namespace vibrosow
