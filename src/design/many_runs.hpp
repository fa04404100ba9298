#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fields/record_figures.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"
#include "simulation/simulate.hpp"

namespace vibrosow {

/// What runs a scene: `simulate`, or something quick in a test.
using Simulator = std::function<Run(const Scene&, const SimulationOptions&)>;

struct Job {
  const Scene* scene;
  std::uint64_t random_seed;
};

/// What came of a job. Neither a run nor a refusal: interrupted before it began.
struct JobResult {
  std::optional<Run> run;              // without its snapshots, which are large
  std::vector<RecordFigures> records;  // of each snapshot
  std::string refused;                 // the simulator's InputError: a fill that does not fit, ...
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

/// Runs every job, begun in order and at most `options.jobs` side by side. Results lie in the order of the jobs
/// whatever the order in which they ended, so the number of threads does not show in them.
std::vector<JobResult> run_jobs(const std::vector<Job>& jobs, const Simulator& simulator,
                                const ManyRunsOptions& options);

}  // namespace vibrosow
