#include "cli/make_replays.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/threads.hpp"
#include "plan/model.hpp"
#include "recording/thinned_recording.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "study/many_runs.hpp"

namespace vibrosow {
namespace {

/// A kept run, and the same made again.
struct Rerun {
  int layout;
  Model model;
  Run kept;
  ThinnedRecording recording;
  Run run{};
};

bool same_event(const OutflowEvent& a, const OutflowEvent& b) {
  return a.time == b.time && a.hole == b.hole && a.lot == b.lot && a.grain == b.grain && a.x == b.x && a.z == b.z;
}

bool same_outflow(const Run& a, const Run& b) {
  return a.end_time == b.end_time && std::ranges::equal(a.events, b.events, same_event);
}

/// All of them side by side; false where they were interrupted.
bool make_again(std::vector<Rerun>& all, const CommonOptions& options) {
  std::vector<Job> jobs;
  for (const Rerun& one : all) jobs.push_back({&one.model, one.kept.random_seed});
  const Simulator recorded = [&](const Model& model, SimulationOptions simulation) {
    Rerun& one = *std::ranges::find(all, &model, [](const Rerun& again) { return &again.model; });
    simulation.observers = one.recording.observers();
    return one.run = run_model(model, simulation);
  };
  complain(fmt::format("no recording of a study's runs is kept: {} {} made again for the replays", all.size(),
                       all.size() == 1 ? "is" : "are"));
  Progress progress(text_unless(options.quiet), static_cast<double>(all.size()), "runs");
  ManyRunsOptions many;
  many.jobs = threads_to_be_had(options.jobs);
  many.interrupt = &watch_for_interrupt();
  many.progress = [&](const ManyRunsProgress& now) { progress.update(now.fraction_done); };
  const std::vector<Evaluation> made = run_jobs(jobs, recorded, many);
  return std::ranges::none_of(made, [](const Evaluation& one) {
    return one.status == EvaluationStatus::absent || one.status == EvaluationStatus::interrupted;
  });
}

nlohmann::ordered_json replay_of(const Rerun& one, std::size_t replays) {
  if (!same_outflow(one.run, one.kept))
    throw InputError(
        fmt::format("--replays: this version of the program makes another run of layout {} than is kept; make the "
                    "study again, or leave out --replays",
                    one.layout));
  nlohmann::ordered_json data = replay_data(one.model.scene, one.run);
  const std::string recording = one.recording.file(most_recording_bytes(replays, data));
  if (recording.empty())
    throw InputError(
        fmt::format("--replays: {} replays have not enough place in one page: not even two frames of layout {} fit; "
                    "ask for fewer",
                    replays, one.layout));
  return page_replay(std::move(data), recording);
}

/// Of those whose run is kept. None where they were interrupted.
std::optional<Replays> make_replays(const std::vector<WantedReplay>& wanted, const KeptRuns& kept,
                                    const CommonOptions& options) {
  std::vector<Rerun> all;
  for (const WantedReplay& one : wanted) {
    std::optional<Run> run = kept(name_of_run(one.scene, one.random_seed));
    if (!run || run->status == RunStatus::refused) continue;
    Model model = prepare_to_run(one.scene);
    ThinnedRecording recording(model);
    all.push_back({one.layout, std::move(model), std::move(*run), std::move(recording)});
  }
  if (!all.empty() && !make_again(all, options)) return std::nullopt;
  Replays replays;
  for (const Rerun& one : all) replays[one.layout] = replay_of(one, all.size());
  return replays;
}

}  // namespace

int add_page_with_replays(const OutputFolder& folder, const std::vector<WantedReplay>& wanted, const KeptRuns& kept,
                          const CommonOptions& options, const std::function<std::string(const Replays&)>& page) {
  const std::optional<Replays> replays = make_replays(wanted, kept, options);
  if (!replays) {
    complain(fmt::format("interrupted before its page was there: vibrosow report {} --replays {}",
                         folder.path().string(), options.replays));
    return exit_interrupted;
  }
  folder.add({"report.html", page(*replays)});
  return exit_done;
}

}  // namespace vibrosow
