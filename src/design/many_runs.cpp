#include "design/many_runs.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <mutex>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// Adds up the shares of runs under way for one progress callback.
class SharedProgress {
 public:
  SharedProgress(std::size_t runs, const std::function<void(const ManyRunsProgress&)>& report)
      : shares_(runs, 0.0), report_(report) {}

  void set_share(std::size_t run, double share) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    total_ += share - shares_[run];
    shares_[run] = share;
    tell();
  }

  void finish(std::size_t run) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    total_ += 1.0 - shares_[run];
    shares_[run] = 1.0;
    ++done_;
    tell();
  }

 private:
  void tell() const { report_({total_ / static_cast<double>(shares_.size()), done_, shares_.size()}); }

  std::mutex mutex_;
  std::vector<double> shares_;
  double total_ = 0;
  std::size_t done_ = 0;
  const std::function<void(const ManyRunsProgress&)>& report_;
};

}  // namespace

std::vector<JobResult> run_jobs(const std::vector<Job>& jobs, const Simulator& simulator,
                                const ManyRunsOptions& options) {
  std::vector<JobResult> results(jobs.size());
  SharedProgress progress(jobs.size(), options.progress);
  const auto interrupted = [&] { return options.interrupt && options.interrupt->load(); };

  const auto run_one = [&](std::size_t index) {
    if (interrupted()) return;
    SimulationOptions simulation;
    simulation.random_seed = jobs[index].random_seed;
    simulation.interrupt = options.interrupt;
    simulation.progress = [&progress, index](double share) { progress.set_share(index, share); };
    try {
      results[index].run = simulator(*jobs[index].scene, simulation);
    } catch (const InputError& error) {
      results[index].refused = error.what();
    }
    progress.finish(index);
  };

  const int wide = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(wide));
  // A pipeline begins the jobs in their order: an interrupted sweep has finished its first layouts, not parts of all.
  std::size_t next = 0;
  const auto next_job = [&](tbb::flow_control& control) -> std::size_t {
    if (next == jobs.size()) control.stop();
    return next++;
  };
  tbb::task_arena(wide).execute([&] {
    tbb::parallel_pipeline(static_cast<std::size_t>(wide),
                           tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, next_job) &
                               tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, run_one));
  });
  return results;
}

}  // namespace vibrosow
