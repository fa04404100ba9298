#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "design/study_runs.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {

/// How the runs of a study are made.
struct MakingFlags {
  std::string save_every = "5 min";
  std::string time_limit;  // empty: none
  bool retry = false;
  bool json_progress = false;
};

/// Adds --save-every, --retry and --progress.
void add_making_flags(CLI::App& command, MakingFlags& flags);

struct Made {
  Making making;
  SweepTiming timing;
  /// What another round, which begins where this one ended, took too.
  void add(const Made& round);
};

/// Makes runs with progress on standard error. A signal to stop, or the time limit, saves those under way.
Made make_runs(StudyRuns& runs, const std::vector<WantedRun>& wanted, const MakingFlags& flags, int jobs, bool quiet);

}  // namespace vibrosow
