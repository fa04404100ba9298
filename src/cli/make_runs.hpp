#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/sweep_report.hpp"
#include "study/study_runs.hpp"

namespace vibrosow {

/// How the runs of a study are made.
struct BatchFlags {
  std::string save_every = "5 min";
  std::string time_limit;  // empty: none
  bool retry = false;
  bool json_progress = false;
};

/// Adds --save-every, --retry and --progress.
void add_making_flags(CLI::App& command, BatchFlags& flags);

struct BatchResult {
  BatchSummary batch;
  SweepTiming timing;
  /// What another round, which begins where this one ended, took too.
  void add(const BatchResult& round);
};

/// Makes runs with progress on standard error. A signal to stop, or the time limit, saves those under way.
BatchResult make_runs(StudyRuns& runs, const std::vector<WantedRun>& wanted, const BatchFlags& flags, int jobs,
                      bool quiet);

/// Throws InputError where runs that were made could not be kept, which is all that such a command is for.
void check_that_all_are_kept(const StudyRuns& runs);

/// Makes the runs of what asks for them round by round.
class RoundExecutor {
 public:
  /// Without `flags` none is made: what is not kept is missing.
  RoundExecutor(StudyRuns& runs, const std::optional<BatchFlags>& flags, int jobs, bool quiet)
      : runs_(runs), flags_(flags), jobs_(jobs), quiet_(quiet) {
    made_.timing.jobs = jobs;
  }

  /// To its end; false where that is interrupted, or runs are missing.
  template <class Asking, class AfterRound>
  bool run_to_decision(Asking& asking, AfterRound after_round) {
    asking.request_next_round();
    for (auto missing = asking.missing(); !missing.empty(); missing = asking.missing()) {
      if (flags_) made_.add(make_runs(runs_, missing, *flags_, jobs_, quiet_));
      if (made_.batch.interrupted > 0 || !asking.take(runs_.kept(), jobs_)) return false;
      asking.request_next_round();
      after_round();
    }
    return true;
  }
  std::int64_t made() const { return made_.batch.made; }
  const SweepTiming& timing() const { return made_.timing; }
  bool quiet() const { return quiet_; }

 private:
  StudyRuns& runs_;
  std::optional<BatchFlags> flags_;
  int jobs_;
  bool quiet_;
  BatchResult made_;
};

}  // namespace vibrosow
