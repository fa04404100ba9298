#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "design/sweep.hpp"
#include "report/columns.hpp"
#include "report/replay.hpp"

namespace vibrosow {

/// The first run of each of the best layouts, at most so many, in the order of the page: those that are ok, the largest
/// rate first.
std::vector<WantedReplay> best_to_replay(const StudyResult& result, std::uint64_t first_random_seed, std::size_t most);

/// The page's numbers and texts (page_text): the layouts with their figures, and how each is built.
std::string sweep_page_data(const StudyResult& result, std::uint64_t first_random_seed, const Replays& replays = {});

/// report.html of a sweep (filled_page).
std::string sweep_page(const std::string& page_template, const StudyResult& result, std::uint64_t first_random_seed,
                       const Replays& replays = {});

/// What the file holds.
FileText sweep_page_text();

}  // namespace vibrosow
