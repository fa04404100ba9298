#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "study/study_runs.hpp"
#include "support/runs_on_demand.hpp"

namespace vibrosow {

/// Leads what asks for runs round by round (StudyDecision, StudyOptimisation, DraftScreen) to its end, or to a run that
/// is not there.
template <class Asking>
void lead_to_the_end(Asking& asking, const Simulator& simulator, int jobs = 1) {
  asking.request_next_round();
  for (auto missing = asking.missing(); !missing.empty(); missing = asking.missing()) {
    if (!asking.take(runs_on_demand(missing, simulator), jobs)) return;
    asking.request_next_round();
  }
}

/// Such a thing is led by one job, killed in its 37th run, and led anew by another through the runs that are kept in
/// `folder`. Returns the runs made after the kill.
template <class Asking>
std::int64_t lead_through_a_kill(const std::filesystem::path& folder, Asking killed, Asking& again,
                                 const Simulator& simulator) {
  std::atomic<bool> interrupt = false;
  std::atomic<int> begun = 0;
  BatchOptions batch;
  batch.jobs = 1;
  batch.interrupt = &interrupt;
  const Simulator dying = [&](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = simulator(model, options);
    if (++begun == 37) interrupt = true, run.status = RunStatus::interrupted;
    return run;
  };
  StudyRuns first(folder);
  killed.request_next_round();
  for (auto missing = killed.missing(); !missing.empty(); missing = killed.missing()) {
    first.make(missing, dying, batch);
    if (!killed.take(first.kept(), 1)) break;
    killed.request_next_round();
  }
  EXPECT_EQ(begun, 37);
  interrupt = false;
  std::int64_t made = 0;
  StudyRuns second(folder);
  again.request_next_round();
  for (auto missing = again.missing(); !missing.empty(); missing = again.missing()) {
    made += second.make(missing, simulator, batch).made;
    EXPECT_TRUE(again.take(second.kept(), 1));
    again.request_next_round();
  }
  return made;
}

}  // namespace vibrosow
