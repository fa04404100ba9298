#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/common_options.hpp"
#include "report/output_folder.hpp"
#include "report/replay.hpp"
#include "study/study_runs.hpp"

namespace vibrosow {

/// Adds report.html to a study's reports: `page` with the replays of these runs, which are made again to be recorded;
/// an exit code. Throws InputError, with no page written, where a run comes out otherwise than the one that is `kept`,
/// or the replays are too many for their place in the page.
int add_page_with_replays(const OutputFolder& folder, const std::vector<WantedReplay>& wanted, const KeptRuns& kept,
                          const CommonOptions& options, const std::function<std::string(const Replays&)>& page);

}  // namespace vibrosow
