#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "design/study_runs.hpp"

namespace vibrosow {

/// What asks for runs round by round (StudyDecision, StudyOptimisation) is led by one job, killed in its 37th run,
/// and led anew by another through the runs that are kept in `folder`. Returns the runs made after the kill.
template <class Asking>
std::int64_t lead_through_a_kill(const std::filesystem::path& folder, Asking killed, Asking& again,
                                 const Simulator& simulator) {
  std::atomic<bool> interrupt = false;
  std::atomic<int> begun = 0;
  MakingOptions making;
  making.jobs = 1;
  making.interrupt = &interrupt;
  const Simulator dying = [&](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = simulator(model, options);
    if (++begun == 37) interrupt = true, run.status = RunStatus::interrupted;
    return run;
  };
  StudyRuns first(folder);
  for (auto wanted = killed.wanted(); !wanted.empty(); wanted = killed.wanted()) {
    first.make(wanted, dying, making);
    if (!killed.take(first.kept(), 1)) break;
  }
  EXPECT_EQ(begun, 37);
  interrupt = false;
  std::int64_t made = 0;
  StudyRuns second(folder);
  for (auto wanted = again.wanted(); !wanted.empty(); wanted = again.wanted()) {
    made += second.make(wanted, simulator, making).made;
    EXPECT_TRUE(again.take(second.kept(), 1));
  }
  return made;
}

}  // namespace vibrosow
