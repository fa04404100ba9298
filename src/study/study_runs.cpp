#include "study/study_runs.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <set>
#include <thread>

#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "plan/softness.hpp"
#include "scene/input_error.hpp"
#include "simulation/checkpoint.hpp"
#include "storage/case_file.hpp"
#include "study/run_in_parallel.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_again_after(200);

bool has_failed(const Run& run) {
  return run.status == RunStatus::refused || run.status == RunStatus::stopped_by_guard;
}

Run refused_run(std::uint64_t random_seed, const std::string& reason) {
  Run run;
  run.status = RunStatus::refused;
  run.random_seed = random_seed;
  run.stop_reason = reason;
  return run;
}

/// True once in each interval of the clock.
class Alarm {
 public:
  explicit Alarm(double every) : every_(every) {}
  bool rings() {
    if (std::chrono::duration<double>(Clock::now() - last_).count() < every_) return false;
    last_ = Clock::now();
    return true;
  }

 private:
  double every_;  // s
  Clock::time_point last_ = Clock::now();
};

/// Takes a note away, whatever ends the work on its run.
class LeaseGuard {
 public:
  LeaseGuard(RunLeases& notes, const std::string& run) : notes_(notes), run_(run) {}
  ~LeaseGuard() { notes_.release(run_); }
  LeaseGuard(const LeaseGuard&) = delete;
  LeaseGuard& operator=(const LeaseGuard&) = delete;

 private:
  RunLeases& notes_;
  const std::string& run_;
};

/// The latest checkpoint that can be read and fits. Others are left alone until the run has ended: another machine may
/// read what this one cannot.
std::optional<SimulationState> state_to_go_on_from(const CheckpointFolder& checkpoints, const std::string& run,
                                                   const Model& model, std::uint64_t random_seed) {
  for (const fs::path& path : checkpoints.of(run)) {
    try {
      SimulationState state = restore(model, text_of_file(path).value_or(""));
      if (state.run.random_seed == random_seed) return state;
    } catch (const InputError&) {
    }
  }
  return std::nullopt;
}

}  // namespace

std::string name_of_run(const Scene& scene, std::uint64_t random_seed) {
  return case_name(case_identity(resolve_accuracy_level(scene), random_seed));
}

/// What is still to be done, and how far it is. Runs that others are making come again after all the rest.
class StudyRuns::Queue {
 public:
  Queue(const std::vector<WantedRun>& wanted, const BatchOptions& options) : options_(options) {
    for (const WantedRun& run : wanted) {
      waiting_.push_back(&run);
      cost_ += run.grain_steps;
    }
    making_.interrupted = static_cast<std::int64_t>(wanted.size());
  }

  bool is_interrupted() const { return failure_.load() || (options_.interrupt && options_.interrupt->load()); }

  const WantedRun* next() {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return nullptr;
    const WantedRun* const run = waiting_.front();
    waiting_.pop_front();
    return run;
  }

  /// Puts a run behind all others; false when it has been there before.
  bool put_off(const WantedRun& run) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(&run);
    return put_off_.insert(&run).second;
  }

  void set_fraction(const WantedRun& run, double fraction) {
    const std::lock_guard lock(mutex_);
    double& known = fractions_[&run];
    done_ += (fraction - known) * run.grain_steps;
    known = fraction;
    if (options_.progress) cost_ > 0 ? options_.progress(done_ / cost_, there_ / cost_) : options_.progress(1, 1);
  }

  void was_there(const WantedRun& wanted) {
    {
      const std::lock_guard lock(mutex_);
      there_ += wanted.grain_steps;
      --making_.interrupted;
      ++making_.there;
    }
    set_fraction(wanted, 1);
  }

  void ended(const WantedRun& wanted, const Run& run) {
    set_fraction(wanted, 1);
    const std::lock_guard lock(mutex_);
    --making_.interrupted;
    ++making_.made;
    making_.run_time += run.wall_time;
    making_.grain_steps += static_cast<double>(run.grain_steps);
    if (options_.on_made) options_.on_made(wanted, run);
  }

  /// Ends the others' work too.
  void fail(std::exception_ptr reason) {
    const std::lock_guard lock(mutex_);
    if (!reason_) reason_ = std::move(reason);
    failure_ = true;
  }

  BatchSummary result() const {
    const std::lock_guard lock(mutex_);
    if (reason_) std::rethrow_exception(reason_);
    return making_;
  }

 private:
  const BatchOptions& options_;
  mutable std::mutex mutex_;
  std::deque<const WantedRun*> waiting_;
  std::set<const WantedRun*> put_off_;
  std::map<const WantedRun*, double> fractions_;
  double cost_ = 0, done_ = 0, there_ = 0;
  BatchSummary making_;
  std::atomic<bool> failure_ = false;
  std::exception_ptr reason_;
};

StudyRuns::StudyRuns(const PathInFolder& own, const std::vector<fs::path>& others,
                     std::chrono::duration<double> patience)
    : own_(own), notes_(own / "running", patience), checkpoints_(own / "checkpoints") {
  folders_.emplace_back(own);
  for (const fs::path& other : others) folders_.emplace_back(other);
}

/// What processes left that were killed while they wrote.
void StudyRuns::sweep_what_was_left() const {
  sweep_temporary_files(own_);
  for (const fs::path& entry : entries_of(own_.path()))
    if (std::error_code none; fs::is_directory(entry, none)) sweep_temporary_files(own_ / entry.filename());
}

BatchSummary StudyRuns::make(const std::vector<WantedRun>& wanted, const Simulator& simulator,
                             const BatchOptions& options) {
  sweep_what_was_left();
  Queue queue(wanted, options);
  run_in_parallel(options.jobs, [&] {
    while (const WantedRun* run = queue.is_interrupted() ? nullptr : queue.next()) {
      if (!wait_for_disk_space(options, queue)) return;
      try {
        if (!attempt(*run, simulator, options, queue) && !queue.put_off(*run))
          std::this_thread::sleep_for(look_again_after);
      } catch (...) {
        queue.fail(std::current_exception());
      }
    }
  });
  keep_waiting();
  for (const std::string& run : checkpoints_.runs())  // of runs that another has ended meanwhile
    if (folders_.front().has(run)) checkpoints_.remove(run);
  try {
    folders_.front().pack(CaseFolder::full_segment);
  } catch (const CannotWrite&) {  // they stay files of their own
  }
  return queue.result();
}

/// Waits until all that was made could be written; false where that takes too long or cannot be, or the work is
/// interrupted.
bool StudyRuns::wait_for_disk_space(const BatchOptions& options, const Queue& queue) {
  const auto begin = Clock::now();
  bool told = false;
  while (!queue.is_interrupted()) {
    keep_waiting();
    const std::optional<CannotWrite> reason = why_not_kept();
    if (!reason) return true;
    if (!reason->for_want_of_room) return false;
    if (!told && options.on_not_kept) options.on_not_kept(reason->what());
    told = true;
    if (std::chrono::duration<double>(Clock::now() - begin).count() >= options.wait_for_room) return false;
    std::this_thread::sleep_for(look_again_after);
  }
  return false;
}

/// False where another process is making it.
bool StudyRuns::attempt(const WantedRun& wanted, const Simulator& simulator, const BatchOptions& options,
                        Queue& queue) {
  if (is_there(wanted, options.retry)) {
    queue.was_there(wanted);
    return true;
  }
  if (!notes_.claim(wanted.name)) return false;
  const LeaseGuard released(notes_, wanted.name);
  if (is_there(wanted, options.retry)) {  // made by another in between
    queue.was_there(wanted);
    return true;
  }
  const Run run = run_on(wanted, simulator, options, queue);
  if (run.status == RunStatus::interrupted) return true;
  keep(case_identity(resolve_accuracy_level(*wanted.scene), wanted.random_seed), run);
  checkpoints_.remove(wanted.name);
  queue.ended(wanted, run);
  return true;
}

bool StudyRuns::is_there(const WantedRun& wanted, bool retry) {
  CaseFolder& own = folders_.front();
  if (own.has(wanted.name)) {
    if (!retry) return true;
    const std::optional<Case> kept = own.named(wanted.name);
    if (kept && !has_failed(kept->run)) return true;
    own.remove(wanted.name);
  }
  for (auto other = std::next(folders_.begin()); other != folders_.end(); ++other) {
    const std::optional<Case> kept = other->named(wanted.name);
    if (!kept || (retry && has_failed(kept->run))) continue;
    keep(kept->identity, kept->run);
    return true;
  }
  return false;
}

Run StudyRuns::run_on(const WantedRun& wanted, const Simulator& simulator, const BatchOptions& options, Queue& queue) {
  try {
    const Model model = prepare_to_run(*wanted.scene);
    SimulationOptions simulation;
    simulation.random_seed = wanted.random_seed;
    simulation.interrupt = options.interrupt;
    simulation.from = state_to_go_on_from(checkpoints_, wanted.name, model, wanted.random_seed);
    simulation.progress = [&](double fraction) {
      notes_.heartbeat(wanted.name, fraction);
      queue.set_fraction(wanted, fraction);
    };
    Alarm alarm(options.save_every);
    simulation.checkpoint_now = [&] { return alarm.rings(); };
    simulation.on_checkpoint = [&](const SimulationState& state) {
      try {
        checkpoints_.keep(wanted.name, state.step, save(model, state));
      } catch (const InputError&) {  // it goes on, and is saved the next time or kept at its end
      }
    };
    return simulator(model, simulation);
  } catch (const InputError& error) {
    return refused_run(wanted.random_seed, error.what());
  }
}

void StudyRuns::keep(const std::string& identity, const Run& run) {
  try {
    folders_.front().keep(identity, run);
    keep_waiting();
  } catch (const CannotWrite& error) {
    const std::lock_guard lock(mutex_);
    waiting_[identity] = run;
    not_kept_ = error;
  }
}

/// What could not be written is tried again.
void StudyRuns::keep_waiting() {
  const std::lock_guard lock(mutex_);
  try {
    while (!waiting_.empty()) {
      folders_.front().keep(waiting_.begin()->first, waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
    }
    not_kept_.reset();
  } catch (const CannotWrite& error) {
    not_kept_ = error;
  }
}

std::optional<Run> StudyRuns::find(const std::string& identity) const {
  if (std::optional<Run> run = folders_.front().find(identity)) return run;
  const std::lock_guard lock(mutex_);
  const auto waiting = waiting_.find(identity);
  return waiting == waiting_.end() ? std::nullopt : std::optional(waiting->second);
}

std::optional<Run> StudyRuns::named(const std::string& name) const {
  if (std::optional<Case> kept = folders_.front().named(name)) return std::move(kept->run);
  const std::lock_guard lock(mutex_);
  const auto waiting = std::ranges::find_if(waiting_, [&](const auto& one) { return case_name(one.first) == name; });
  return waiting == waiting_.end() ? std::nullopt : std::optional(waiting->second);
}

KeptRuns StudyRuns::kept() const {
  return [this](const std::string& name) { return named(name); };
}

Simulator StudyRuns::caching_simulator(Simulator simulator) {
  return [this, simulator = std::move(simulator)](const Model& model, const SimulationOptions& options) {
    const std::string identity = case_identity(model.scene, options.random_seed);
    if (std::optional<Run> run = find(identity)) return std::move(*run);
    Run run = simulator(model, options);
    if (run.status != RunStatus::interrupted) keep(identity, run);
    return run;
  };
}

std::optional<CannotWrite> StudyRuns::why_not_kept() const {
  const std::lock_guard lock(mutex_);
  return not_kept_;
}

std::string StudyRuns::not_kept() const {
  const std::optional<CannotWrite> reason = why_not_kept();
  return reason ? reason->what() : "";
}

}  // namespace vibrosow
