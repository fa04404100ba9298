#pragma once

#include <string>

#include "accuracy/accuracy.hpp"
#include "accuracy/promise.hpp"
#include "report/columns.hpp"

namespace vibrosow {

/// The page's numbers and texts (page_text): what is recommended, and every setting with its error and its cost.
std::string accuracy_page_data(const Scene& scene, const AccuracyResult& result);

/// The same of a promise and the runs that it was made by.
std::string accuracy_page_data(const Scene& scene, const Promise& promise, const PromiseGoal& goal);

/// What report.html holds.
FileText accuracy_page_text();

}  // namespace vibrosow
