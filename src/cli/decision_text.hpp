#pragma once

#include <string>

#include "report/decision_report.hpp"

namespace vibrosow {

/// A decision for a screen: the answer first, then the layouts that may be as good, then what it cost and what is to be
/// thought of it.
std::string decision_text(const DecisionReport& report);

}  // namespace vibrosow
