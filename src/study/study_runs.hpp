#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "storage/case_folder.hpp"
#include "storage/checkpoint_folder.hpp"
#include "storage/run_leases.hpp"
#include "study/evaluate.hpp"

namespace vibrosow {

/// A run that is to be there.
struct WantedRun {
  const Scene* scene;
  std::uint64_t random_seed;
  std::string name;        // of its case
  double grain_steps = 1;  // what it costs, for progress
  int layout = 0;          // its number
};

/// The name under which a run of a scene is kept. Throws as `prepare` does.
std::string name_of_run(const Scene& scene, std::uint64_t random_seed);

/// Gives the run of such a name where it is kept. For several threads.
using KeptRuns = std::function<std::optional<Run>(const std::string& name)>;

struct BatchOptions {
  int jobs = 0;                                  // runs side by side; 0: one per core
  const std::atomic<bool>* interrupt = nullptr;  // true saves the runs under way and begins no other
  double save_every = 300;                       // s of the clock, between checkpoints of a run under way
  bool retry = false;                            // runs that were refused, or stopped by the guard, are made anew
  double wait_for_room = 600;                    // s of the clock: how long a full disk or quota is waited for
  std::function<void(const std::string&)> on_not_kept{};  // why runs wait to be written; once for each wait
  /// Of all cost, and how much of that was there already; called by one thread at a time.
  std::function<void(double fraction_done, double fraction_there)> progress{};
  std::function<void(const WantedRun&, const Run&)> on_made{};  // likewise, of every run that was made here
};

/// What came of making runs.
struct BatchSummary {
  std::int64_t made = 0;         // that ended
  std::int64_t there = 0;        // from before, from another folder, or made by another process meanwhile
  std::int64_t interrupted = 0;  // begun and not ended, or not begun
  double run_time = 0;           // s of the clock, of those made, summed
  double grain_steps = 0;        // of those made
};

/// The runs of a study in its folder: makes those that are missing and keeps each as soon as it has ended. A run that
/// another process is making is left for later, and made here where that process is gone. What was interrupted is saved
/// and goes on from there, to the same bytes.
class StudyRuns {
 public:
  /// `own`: a sweep's "cases", written into; `others` are only read. `patience`: RunLeases'.
  StudyRuns(const PathInFolder& own, const std::vector<std::filesystem::path>& others = {},
            std::chrono::duration<double> patience = std::chrono::seconds(30));

  /// Returns when every wanted run is there, made by whomever, or when it is interrupted. A scene that cannot be run
  /// gives a run that is `refused`, which is kept too. Throws InputError where another program made another run of it
  /// and CannotWrite where there is no right to write. Where a run could not be kept for another reason than a full
  /// disk, no other is begun.
  BatchSummary make(const std::vector<WantedRun>& wanted, const Simulator& simulator, const BatchOptions& options);

  /// The run that is kept under a case's name, here or waiting to be written; none: there is none.
  std::optional<Run> named(const std::string& name) const;

  /// The same as a function, which refers to this.
  KeptRuns kept() const;

  /// A simulator that gives the run that is kept or, where there is none, makes it by another and keeps it: for runs
  /// whose number is small and that are wanted one by one. What is interrupted is not kept. For several threads.
  Simulator caching_simulator(Simulator simulator);

  /// Why the first run that could not be written could not; empty where all could. Such runs are in memory alone and
  /// tried again; no other is begun meanwhile.
  std::string not_kept() const;

 private:
  class Queue;

  bool attempt(const WantedRun& wanted, const Simulator& simulator, const BatchOptions& options, Queue& queue);
  bool is_there(const WantedRun& wanted, bool retry);
  std::optional<Run> find(const std::string& identity) const;
  Run run_on(const WantedRun& wanted, const Simulator& simulator, const BatchOptions& options, Queue& queue);
  void keep(const std::string& identity, const Run& run);
  void keep_waiting();
  std::optional<CannotWrite> why_not_kept() const;
  bool wait_for_disk_space(const BatchOptions& options, const Queue& queue);

  void sweep_what_was_left() const;

  PathInFolder own_;
  std::deque<CaseFolder> folders_;  // one's own first
  RunLeases notes_;
  CheckpointFolder checkpoints_;
  mutable std::mutex mutex_;
  std::map<std::string, Run> waiting_;  // by identity: could not be written
  std::optional<CannotWrite> not_kept_;
};

}  // namespace vibrosow
