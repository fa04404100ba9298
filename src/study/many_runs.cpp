#include "study/many_runs.hpp"

#include <atomic>
#include <mutex>

#include "study/run_in_parallel.hpp"

namespace vibrosow {
namespace {

/// Adds up the fractions of runs under way for one progress callback.
class SharedProgress {
 public:
  SharedProgress(std::size_t runs, const std::function<void(const ManyRunsProgress&)>& report)
      : fractions_(runs, 0.0), report_(report) {}

  void set_fraction(std::size_t run, double fraction) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    total_ += fraction - fractions_[run];
    fractions_[run] = fraction;
    tell();
  }

  void finish(std::size_t run) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    total_ += 1.0 - fractions_[run];
    fractions_[run] = 1.0;
    ++done_;
    tell();
  }

 private:
  void tell() const { report_({total_ / static_cast<double>(fractions_.size()), done_, fractions_.size()}); }

  std::mutex mutex_;
  std::vector<double> fractions_;
  double total_ = 0;
  std::size_t done_ = 0;
  const std::function<void(const ManyRunsProgress&)>& report_;
};

}  // namespace

std::vector<Evaluation> run_jobs(const std::vector<Job>& jobs, const Simulator& simulator,
                                 const ManyRunsOptions& options) {
  std::vector<Evaluation> results(jobs.size());
  SharedProgress progress(jobs.size(), options.progress);
  const auto interrupted = [&] { return options.interrupt && options.interrupt->load(); };

  const auto run_one = [&](std::size_t index) {
    results[index].random_seed = jobs[index].random_seed;
    if (interrupted()) return;
    SimulationOptions simulation;
    simulation.random_seed = jobs[index].random_seed;
    simulation.interrupt = options.interrupt;
    simulation.progress = [&progress, index](double fraction) { progress.set_fraction(index, fraction); };
    results[index] = evaluate(*jobs[index].model, simulation, jobs[index].curves, simulator, jobs[index].drills);
    progress.finish(index);
  };

  run_in_parallel(options.jobs, jobs.size(), run_one);
  return results;
}

}  // namespace vibrosow
