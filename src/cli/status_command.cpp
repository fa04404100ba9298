#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "cli/adaptive_study.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/progress.hpp"
#include "cli/report_study.hpp"
#include "report/terminal_text.hpp"
#include "scene/printable.hpp"
#include "storage/case_folder.hpp"
#include "storage/checkpoint_folder.hpp"
#include "storage/run_leases.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

struct Status {
  std::size_t kept = 0;
  double cost_left = 0;                              // grain-steps of what is missing
  std::map<std::string, const PlannedRun*> missing;  // by name
  std::map<std::string, int> failed;                 // by what happened
};

Status status_of(const std::vector<PlannedRun>& runs, const CaseFolder& cases) {
  Status status;
  for (const PlannedRun& run : runs) {
    const std::optional<Case> one = cases.named(run.name);
    if (!one) {
      status.missing[run.name] = &run;
      status.cost_left += run.grain_steps;
      continue;
    }
    ++status.kept;
    if (one->run.status == RunStatus::stopped_by_guard)
      ++status.failed["stopped by the guard: " + one->run.stop_reason];
    if (one->run.status == RunStatus::refused) ++status.failed["could not begin: " + one->run.stop_reason];
  }
  return status;
}

/// s by this machine's clock, since a time that a note gives.
double seconds_since(const std::string& time) {
  std::tm parts{};
  std::istringstream(time) >> std::get_time(&parts, "%Y-%m-%dT%H:%M:%SZ");
  return std::difftime(std::time(nullptr), timegm(&parts));
}

/// Prints the runs under way and gives the grain-steps a second that they make together.
double print_under_way(const std::vector<RunNote>& notes, const Status& status) {
  double rate = 0;
  for (const RunNote& note : notes) {
    const auto run = status.missing.find(note.run);
    if (run == status.missing.end()) continue;
    print_text(wrapped(
        fmt::format("layout {}, random seed {}: {:.0f} % done, by process {} of {} since {}", run->second->layout,
                    run->second->random_seed, 100 * note.fraction, note.process, note.host, note.since),
        2));
    if (const double passed = seconds_since(note.since); passed > 0 && note.from_fraction >= 0)
      rate += (note.fraction - note.from_fraction) * run->second->grain_steps / passed;
  }
  return rate;
}

/// Leaves in a plan the runs that have been asked for so far, and says whether more may follow.
std::string follow(StudyPlan& plan, AdaptiveStudy& asked, const std::string& folder) {
  StudyRuns runs(cases_of(folder));
  RoundExecutor rounds(runs, std::nullopt, 1, true);
  const bool has_ended = asked.run_to_decision(rounds);
  plan.runs = asked.asked_for();
  return fmt::format("vibrosow {} has {}\n", command_of(plan.question),
                     has_ended ? "ended" : "asked for these so far; more may follow");
}

/// How far a study is, and what has failed.
void print_status(const std::string& folder) {
  StudyPlan plan = read_plan(folder);
  const auto asked = adaptive_study(plan);
  const std::string so_far = asked ? follow(plan, *asked, folder) : "";
  const Status status = status_of(plan.runs, CaseFolder(cases_of(folder)));
  print("{}\n{} of {} runs are there, {} are missing\n{}", printable(plan.study), status.kept, plan.runs.size(),
        status.missing.size(), so_far);
  const double rate = print_under_way(RunLeases(cases_of(folder) / "running").all(), status);
  const auto saved = std::ranges::count_if(CheckpointFolder(cases_of(folder) / "checkpoints").runs(),
                                           [&](const std::string& run) { return status.missing.contains(run); });
  if (saved > 0) print("{} of these saved part of the way\n", saved);
  for (const auto& [what, runs] : status.failed) print_text(wrapped(fmt::format("{} {}", runs, what), 2));
  if (!status.failed.empty()) print_text("with --retry the same command repeats those\n");
  if (status.missing.empty()) {
    const std::string more = asked ? "" : more_runs_needed(study_of_plan(plan), folder, 1);
    if (!more.empty()) print_text(wrapped(more));
    return;
  }
  if (rate > 0)
    print("{} left, at the current speed\n", duration_text(status.cost_left / rate));
  else
    print_text("give the command that began the study again: it makes the missing runs\n");
}

}  // namespace

void add_status_command(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("status", "show a study's progress");
  command->add_option("FOLDER", *folder, "of a sweep, decide or optimise")->required();
  add_examples(*command, {"vibrosow status out/wheat-demo", "vibrosow status best", "vibrosow status front"});
  command->callback([folder, &exit_code] {
    print_status(*folder);
    exit_code = exit_done;
  });
}

}  // namespace vibrosow
