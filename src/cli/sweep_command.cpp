#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "cli/report_study.hpp"
#include "cli/reused_cases.hpp"
#include "input/input_file.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

struct SweepCommandOptions {
  CommonOptions common;
  BatchFlags batch;
  std::vector<std::string> reuse;  // folders of other sweeps
};

/// Round by round where replicates are by need; `planned` is then the last round.
BatchResult make_all_runs(PlannedStudy& planned, StudyRuns& runs, const std::filesystem::path& folder,
                          const SweepCommandOptions& command) {
  const CommonOptions& options = command.common;
  freeze_plan(folder, planned.plan);
  BatchResult made = make_runs(runs, wanted_runs(planned), command.batch, options.jobs, options.quiet);
  while (made.batch.interrupted == 0) {
    std::optional<PlannedStudy> next = next_round(planned, runs.kept(), options.jobs);
    if (!next) break;
    const std::size_t more = next->plan.runs.size() - planned.plan.runs.size();
    if (!options.quiet && !command.batch.json_progress)
      complain(fmt::format("{} run{} more, for the interval that is wanted", more, more == 1 ? "" : "s"));
    planned = std::move(*next);
    freeze_plan(folder, planned.plan);
    made.add(make_runs(runs, wanted_runs(planned), command.batch, options.jobs, options.quiet));
  }
  return made;
}

int run_sweep(const SweepCommandOptions& command) {
  const CommonOptions& options = command.common;
  const InputFile file = input_file(options.file, FileKind::study);
  PlannedStudy planned = plan_study(file.path, options.sets, options.random_seed, file.files);
  print_warnings(study_warnings(planned.study));
  tell_of_files(file);
  const std::string page_template = options.page_template();
  const OutputFolder folder = options.output_folder("sweep", sweep_file_texts());
  StudyRuns runs(cases_of(folder.path()), cases_to_reuse(command.reuse));
  const BatchResult made = make_all_runs(planned, runs, folder.path(), command);
  const int exit_code = report_study(planned, runs, folder, made.timing, options, page_template);
  if (!options.quiet && made.batch.there > 0) print("{} of the runs were kept from before\n", made.batch.there);
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  if (!runs.not_kept().empty()) complain("warning: runs are not kept: " + runs.not_kept());
  return exit_code;
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepCommandOptions>();
  CLI::App* command =
      app.add_subcommand("sweep", "simulate every layout of a study; compare with measured outflow if it names some");
  add_common_options(*command, options->common, "study file (.toml)");
  add_html_option(*command, options->common);
  add_replays_option(*command, options->common);
  add_making_flags(*command, options->batch);
  add_reuse_option(*command, options->reuse);
  add_examples(*command,
               {"vibrosow sweep wheat-demo", "vibrosow sweep wheat-demo --set replicates=4 --html --replays 1",
                "vibrosow sweep wheat-holes --set replicates=1 --out holes"});
  command->callback([options, &exit_code] { exit_code = run_sweep(*options); });
}

}  // namespace vibrosow
