#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "cli/adaptive_study.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/report_study.hpp"
#include "cli/run_answer.hpp"
#include "input/wording.hpp"
#include "plan/model.hpp"
#include "plan/scene_warnings.hpp"
#include "report/run_report.hpp"
#include "scene/input_error.hpp"
#include "simulation/state.hpp"
#include "storage/case_folder.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

struct ExportOptions {
  CommonOptions common;
  bool complete = false;
  std::string run;
};

/// The reports of one kept run, as `run` makes them.
int export_run(const ExportOptions& command) {
  const CommonOptions& options = command.common;
  const PlannedStudy planned = study_of_plan(read_plan(options.file));
  const std::vector<PlannedRun>& runs = planned.plan.runs;
  const auto run = std::ranges::find(runs, command.run, &PlannedRun::name);
  if (run == runs.end())
    throw InputError(fmt::format("{}: its plan has no run {}", options.file, shortened(command.run)));
  std::optional<Case> found = CaseFolder(cases_of(options.file)).named(command.run);
  if (!found) throw InputError(fmt::format("{}: run {} is not kept", options.file, command.run));
  const std::size_t index = static_cast<std::size_t>(run - runs.begin());
  const Layout& layout = planned.study.layouts.at(static_cast<std::size_t>(run->layout) - 1);
  const Scene& scene = *wanted_runs(planned, {index}).front().scene;
  const Model model = prepare(scene);
  found->run.drawn = starting_state(model, run->random_seed).run.drawn;  // which a kept run has not
  const OutputFolder folder = options.output_folder("run", run_file_texts());
  const RunAnswer answer =
      answer_of_run(model.scene, found->run, scene_warnings(scene), knowledge_for(planned.study), layout.drill);
  folder.write(files_of_run(model, found->run, answer, options.csv, "", ""));
  print("reports: {}\n", folder.path().string());
  return exit_done;
}

/// Throws InputError where one is.
void check_that_none_is_missing(const std::string& folder, const std::vector<PlannedRun>& runs) {
  const std::size_t missing = missing_runs(folder, runs);
  if (missing > 0) throw InputError(fmt::format("{}: {} of {} runs are missing", folder, missing, runs.size()));
}

int export_sweep(const StudyPlan& plan, const ExportOptions& command) {
  const CommonOptions& options = command.common;
  const PlannedStudy planned = study_of_plan(plan);
  StudyRuns runs(cases_of(options.file));
  const auto more = [&] { return more_runs_needed(planned, options.file, options.jobs); };
  if (command.complete) {
    check_that_none_is_missing(options.file, plan.runs);
    if (const std::string needed = more(); !needed.empty())
      throw InputError(fmt::format("{}: {}", options.file, needed));
  }
  const OutputFolder folder = options.output_folder("sweep", sweep_file_texts());
  const int exit_code = report_study(planned, runs, folder, {.jobs = options.jobs}, options, "");
  if (exit_code == exit_interrupted || command.complete) return exit_code;
  if (const std::string needed = more(); !needed.empty()) complain("warning: " + needed);
  return exit_code;
}

int export_asked(AdaptiveStudy& asked, const ExportOptions& command) {
  const CommonOptions& options = command.common;
  StudyRuns runs(cases_of(options.file));
  RoundExecutor rounds(runs, std::nullopt, options.jobs, true);
  asked.run_to_decision(rounds);
  if (command.complete) check_that_none_is_missing(options.file, asked.asked_for());
  return asked.report(asked.folder(options), options, "");
}

int export_study(ExportOptions command) {
  CommonOptions& options = command.common;
  if (command.run.empty() != options.out.empty()) throw InputError("--run and --out go together");
  if (!command.run.empty()) return export_run(command);
  options.out = options.file;
  const StudyPlan plan = read_plan(options.file);
  const auto asked = adaptive_study(plan);
  const int exit_code = asked ? export_asked(*asked, command) : export_sweep(plan, command);
  print("reports: {}\n", options.out);
  if (exit_code != exit_interrupted) return exit_code;
  complain("warning: runs are missing");
  return exit_done;
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "write a study's reports from its kept runs, without simulating");
  command->add_option("FOLDER", options->common.file, "of a sweep, decide or optimise")->required();
  command->add_flag("--complete", options->complete,
                    "write nothing, with exit code 2, while runs are missing or an interval needs more");
  command->add_option("--run", options->run, "name of a kept run (cases/plans): write only its reports, as run does")
      ->type_name("NAME");
  command->add_option("--out", options->common.out, "directory for the reports of --run")->type_name("DIR");
  add_csv_option(*command, options->common);
  add_examples(*command, {"vibrosow export out/wheat-demo", "vibrosow export best",
                          "vibrosow export out/wheat-demo --csv semicolon"});
  command->callback([options, &exit_code] { exit_code = export_study(*options); });
}

}  // namespace vibrosow
