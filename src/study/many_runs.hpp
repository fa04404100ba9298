#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "study/evaluate.hpp"

namespace vibrosow {

struct Job {
  const Model* model;
  std::uint64_t random_seed;
  std::vector<CurveRequest> curves{};
  std::vector<Drill> drills{};
};

struct ManyRunsProgress {
  double fraction_done;  // 0..1, runs under way counted by their fractions
  std::size_t runs_done;
  std::size_t runs;
};

struct ManyRunsOptions {
  int jobs = 0;                                           // runs side by side; 0: one per core
  const std::atomic<bool>* interrupt = nullptr;           // true ends the runs under way and begins no other
  std::function<void(const ManyRunsProgress&)> progress;  // called by one thread at a time
};

/// Evaluates every job, begun in order and at most `options.jobs` side by side. Results lie in the order of the jobs
/// whatever the order in which they ended, so the number of threads does not show in them.
std::vector<Evaluation> run_jobs(const std::vector<Job>& jobs, const Simulator& simulator,
                                 const ManyRunsOptions& options);

}  // namespace vibrosow
