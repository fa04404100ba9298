#include "cli/report_study.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

#include "answer/answer.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/make_replays.hpp"
#include "cli/sweep_table.hpp"
#include "report/page.hpp"
#include "report/study_page.hpp"
#include "scene/input_error.hpp"
#include "storage/case_folder.hpp"
#include "storage/study_plan.hpp"
#include "study/sweep.hpp"

namespace vibrosow {
namespace {

/// Whether no layout lacks runs.
bool is_whole(const StudyResult& result) {
  return std::ranges::none_of(result.layouts,
                              [](const LayoutResult& one) { return one.status == LayoutStanding::incomplete; });
}

/// The current plan; none where there is none that this version can read.
std::optional<StudyPlan> plan_there(const std::filesystem::path& folder) {
  try {
    return read_plan(folder);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

int exit_code_of(const StudyResult& result, bool interrupted) {
  if (interrupted) return exit_interrupted;
  const auto stopped = std::ranges::find(result.layouts, LayoutStanding::stopped, &LayoutResult::status);
  if (stopped != result.layouts.end())
    return stopped_by_guard(static_cast<int>(stopped - result.layouts.begin()) + 1, stopped->reason);
  const bool all_invalid = std::ranges::all_of(
      result.layouts, [](const LayoutResult& one) { return one.status == LayoutStanding::invalid; });
  if (!all_invalid) return exit_done;
  complain("no layout could be simulated: " + result.layouts.front().reason);
  return exit_wrong_input;
}

}  // namespace

int stopped_by_guard(int layout, const std::string& reason) {
  complain(fmt::format("the guard stopped layout {}: {}", layout, reason));
  return exit_stopped_by_guard;
}

std::string begin_study(const OutputFolder& folder, const StudyPlan& plan, bool quiet) {
  const std::optional<StudyPlan> former = plan_there(folder.path());
  const bool removed = !(former && are_of_one_study(*former, plan)) && folder.clear();
  if (removed && !quiet)
    print_notes({fmt::format("{} held reports of another study, or without their plan, which are removed; runs stay",
                             folder.path().string())});
  return freeze_plan(folder.path(), plan);
}

std::size_t missing_runs(const std::filesystem::path& folder, const std::vector<PlannedRun>& runs) {
  const CaseFolder cases(cases_of(folder));
  return static_cast<std::size_t>(
      std::ranges::count_if(runs, [&](const PlannedRun& run) { return !cases.has(run.name); }));
}

std::string more_runs_needed(const PlannedStudy& planned, const std::filesystem::path& folder, int jobs) {
  const std::optional<PlannedStudy> next = next_round(planned, StudyRuns(cases_of(folder)).kept(), jobs);
  if (!next) return "";
  const std::size_t more = next->plan.runs.size() - planned.plan.runs.size();
  return fmt::format(
      "{} more run{} needed for the interval that is wanted: {} plans them, and the same sweep makes them at once",
      more, more == 1 ? " is" : "s are", typed_line({"submit", folder.string()}));
}

void warn_of_lacking_runs(const PlannedStudy& planned, const StudyResult& result, const std::filesystem::path& folder,
                          int jobs) {
  const std::string lacking = is_whole(result) ? more_runs_needed(planned, folder, jobs) : "runs are missing";
  if (!lacking.empty()) complain("warning: " + lacking);
}

int add_sweep_page_with_replays(const PlannedStudy& planned, const StudyRuns& runs, const OutputFolder& folder,
                                const StudyResult& result, const CommonOptions& options,
                                const std::string& page_template) {
  const StudyPage page = study_page(result, planned.plan.random_seed);
  return add_page_with_replays(
      folder, best_to_replay(page.answer, options.replays), runs.kept(), options,
      [&](const Replays& replays) { return filled_page(page_template, page_data(page, replays)); });
}

int report_study(const PlannedStudy& planned, const StudyRuns& runs, const OutputFolder& folder,
                 const SweepTiming& timing, const CommonOptions& options, const std::string& page_template) {
  SweepRunsCsv runs_csv(planned.study, options.csv);
  const StudyResult result = answer_of_kept(
      planned, runs.kept(), timing.jobs,
      [&](std::size_t scene, const std::vector<Evaluation>& of_scene) { runs_csv.add(scene, of_scene); });
  const Answer answer = answer_of(result, planned.plan.random_seed);
  std::vector<OutputFile> files = sweep_files(answer, result, runs_csv, timing, options.csv);
  const bool whole = is_whole(result);
  const bool with_replays = options.replays > 0 && whole;
  if (!page_template.empty() && !with_replays)
    files.push_back(
        {"report.html", filled_page(page_template, page_data(study_page(result, planned.plan.random_seed)))});
  write_then_print(
      options.quiet, [&] { folder.write(files); }, [&] { print_sweep_table(result); });
  const int of_page =
      with_replays ? add_sweep_page_with_replays(planned, runs, folder, result, options, page_template) : exit_done;
  return of_page == exit_done ? exit_code_of(result, !whole) : of_page;
}

}  // namespace vibrosow
