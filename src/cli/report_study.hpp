#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/common_options.hpp"
#include "report/sweep_report.hpp"
#include "study/planned_study.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// Says which layout the guard stopped, and why; an exit code.
int stopped_by_guard(int layout, const std::string& reason);

/// Makes a plan the current one of a folder whose reports come later, by another command, and gives its name. Reports
/// there of another study, or of none that is kept, are removed before, with a note unless `quiet`: they would be taken
/// for its own.
std::string begin_study(const OutputFolder& folder, const StudyPlan& plan, bool quiet);

/// How many of the planned runs a study's folder does not keep.
std::size_t missing_runs(const std::filesystem::path& folder, const std::vector<PlannedRun>& runs);

/// Of a sweep of which no run is missing: that its wanted interval needs more, and how they are made; else empty.
std::string more_runs_needed(const PlannedStudy& planned, const std::filesystem::path& folder, int jobs);

/// Warns where the answer of a sweep's kept runs lacks runs, or its wanted interval needs more.
void warn_of_lacking_runs(const PlannedStudy& planned, const StudyResult& result, const std::filesystem::path& folder,
                          int jobs);

/// Adds a sweep's page with the replays that the options ask for (add_page_with_replays).
int add_sweep_page_with_replays(const PlannedStudy& planned, const StudyRuns& runs, const OutputFolder& folder,
                                const StudyResult& result, const CommonOptions& options,
                                const std::string& page_template);

/// Makes a study's reports of the runs that are kept, and prints its table; an exit code. With a
/// `page_template`, its page too, with the replays that the options ask for.
int report_study(const PlannedStudy& planned, const StudyRuns& runs, const OutputFolder& folder,
                 const SweepTiming& timing, const CommonOptions& options, const std::string& page_template);

}  // namespace vibrosow
