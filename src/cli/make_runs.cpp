#include "cli/make_runs.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <string_view>
#include <thread>

#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/leading_layouts.hpp"
#include "cli/progress.hpp"
#include "cli/threads.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// Sets a flag when a signal to stop has come, or the time is over.
class Deadline {
 public:
  /// `limit`: s; 0: none.
  explicit Deadline(double limit) : signal_(watch_for_interrupt()) {
    if (limit > 0) watch_ = std::jthread([this, limit](const std::stop_token& ended) { wait(ended, limit); });
  }

  /// The signal itself where there is no limit.
  const std::atomic<bool>& flag() const { return watch_.joinable() ? over_ : signal_; }

 private:
  void wait(const std::stop_token& ended, double limit) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
    while (!ended.stop_requested() && !signal_ && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (!ended.stop_requested()) over_ = true;
  }

  const std::atomic<bool>& signal_;
  std::atomic<bool> over_ = false;
  std::jthread watch_;
};

std::string_view status_text(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::stopped_by_guard:
      return "stopped";
    case RunStatus::refused:
      return "refused";
    case RunStatus::interrupted:
      break;
  }
  return "interrupted";
}

std::string event_fields(const WantedRun& wanted, const Run& run) {
  return fmt::format(R"("case":"{}","layout":{},"random_seed":{},"status":"{}","seeds":{},"wall_s":{:.3f})",
                     wanted.name, wanted.layout, wanted.random_seed, status_text(run.status), run.balance.counted,
                     run.wall_time);
}

}  // namespace

void add_making_flags(CLI::App& command, BatchFlags& flags) {
  command
      .add_option("--save-every", flags.save_every,
                  "clock time between saves of unfinished runs, which resume from there")
      ->type_name("TIME")
      ->capture_default_str();
  command.add_flag("--retry", flags.retry, "repeat runs that could not begin or that the guard stopped");
  command
      .add_option_function<std::string>(
          "--progress", [&flags](const std::string& style) { flags.json_progress = style == "json"; },
          "text, or json: one line of JSON per event, on standard error")
      ->type_name("STYLE")
      ->check(CLI::IsMember({"text", "json"}))
      ->default_str("text");
}

void BatchResult::add(const BatchResult& round) {
  batch.made += round.batch.made;
  batch.interrupted = round.batch.interrupted;  // what was there is the same, and what was made before
  timing.wall_time += round.timing.wall_time;
  timing.runs += round.timing.runs;
  timing.run_time += round.timing.run_time;
  timing.grain_steps += round.timing.grain_steps;
}

BatchResult make_runs(StudyRuns& runs, const std::vector<WantedRun>& wanted, const BatchFlags& flags, int jobs,
                      bool quiet) {
  BatchOptions batch;
  batch.jobs = threads_to_be_had(jobs);
  batch.retry = flags.retry;
  batch.save_every = time_option("--save-every", flags.save_every);
  const Deadline deadline(flags.time_limit.empty() ? 0 : time_option("--time-limit", flags.time_limit));
  batch.interrupt = &deadline.flag();
  LeadingLayouts leading;
  Progress progress(flags.json_progress ? ProgressStyle::json : text_unless(quiet), static_cast<double>(wanted.size()),
                    "runs");
  progress.show_also([&] { return leading.text(); });
  progress.tell("begin", fmt::format(R"("runs":{})", wanted.size()));
  batch.on_not_kept = [](const std::string& reason) {
    complain(fmt::format("warning: {}; no further run is begun until there is room", reason));
  };
  batch.progress = [&](double done, double there) {
    progress.begin_at(there);
    progress.update(done);
  };
  batch.on_made = [&](const WantedRun& run, const Run& made) {
    leading.add(run, made);
    progress.tell("run", event_fields(run, made));
  };
  BatchResult made;
  made.batch = runs.make(wanted, run_model, batch);
  progress.tell("end", fmt::format(R"("made":{},"there":{},"left":{})", made.batch.made, made.batch.there,
                                   made.batch.interrupted));
  made.timing = {progress.seconds(), batch.jobs, made.batch.made, made.batch.run_time, made.batch.grain_steps};
  return made;
}

void check_that_all_are_kept(const StudyRuns& runs) {
  if (const std::string reason = runs.not_kept(); !reason.empty()) throw InputError("runs are not kept: " + reason);
}

}  // namespace vibrosow
