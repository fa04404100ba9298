#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "design/optimise.hpp"
#include "report/columns.hpp"
#include "report/replay.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {

/// The first run of each layout that leads, at most so many, in the order of the page's table.
std::vector<WantedReplay> best_to_replay(const OptimiseResult& result, std::size_t most);

/// The page's numbers and texts (page_text): what was asked, the layouts with their standings, and how each is built.
/// `timing`: of the runs that were made for it just now.
std::string front_page_data(const OptimiseResult& result, const SweepTiming& timing, const Replays& replays = {});

/// What the file holds.
FileText front_page_text();

}  // namespace vibrosow
