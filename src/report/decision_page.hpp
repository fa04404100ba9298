#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/columns.hpp"
#include "report/decision_report.hpp"
#include "report/replay.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {

/// The first run of the best layout and of each that is not shown to be worse, or that may still be the best; at most
/// so many, in the order of the page.
std::vector<WantedReplay> best_to_replay(const DecisionReport& report, std::size_t most);

/// The page's numbers and texts (page_text): the answer, what was asked, the layouts with their standings, and how each
/// is built. `timing`: of the runs that were made for it just now.
std::string decision_page_data(const DecisionReport& report, const SweepTiming& timing, const Replays& replays = {});

/// What the file holds.
FileText decision_page_text();

}  // namespace vibrosow
