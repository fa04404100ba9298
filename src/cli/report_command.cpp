#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/adaptive_study.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/report_study.hpp"
#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "plan/model.hpp"
#include "recording/recording.hpp"
#include "report/accuracy_report.hpp"
#include "report/calibration_report.hpp"
#include "report/kept_page.hpp"
#include "report/page.hpp"
#include "report/run_page.hpp"
#include "report/run_report.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"
#include "simulation/simulate.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// A run again for its replay; empty where it was interrupted. Throws InputError where it comes out otherwise.
std::string recording_of_rerun(const Json& data, const CommonOptions& options) {
  const Model model = prepare_to_run(scene_from_json(data.at("scene").dump()));
  complain("the folder keeps no recording: the run is made again for the replay");
  Recording recording(model);
  SimulationOptions simulation;
  simulation.random_seed = seed_number(data.at("random_seed"));
  simulation.interrupt = &watch_for_interrupt();
  simulation.observers = recording.observers();
  Progress progress(text_unless(options.quiet), static_cast<double>(model.step.steps), "steps");
  simulation.progress = [&](double fraction) { progress.update(fraction); };
  const Run run = run_model(model, simulation);
  if (run.status == RunStatus::interrupted) return "";
  if (page_events(run) != data.at("events"))
    throw InputError(
        fmt::format("{}: this version of the program makes another run of it; run it again with --html", options.file));
  return recording.file();
}

/// What a run's page replays: of the page that is there, or of the run made again. A run that was cut short has none.
std::optional<std::string> recording_of_run(const Json& data, const CommonOptions& options) {
  if (const auto page = text_of_file(std::filesystem::path(options.file) / "report.html"))
    if (std::string recording = recording_in(*page); !recording.empty()) return recording;
  if (data.at("status") == "interrupted") return "";
  std::string recording = recording_of_rerun(data, options);
  if (recording.empty()) return std::nullopt;
  return recording;
}

/// Where the page of a kind goes.
OutputFolder folder_of(const std::string& kind, const CommonOptions& options) {
  if (kind == "run") return options.output_folder("run", run_file_texts());
  if (kind == "accuracy") return options.output_folder("accuracy", accuracy_file_texts());
  if (kind == "calibration") return options.output_folder("calibrate", calibration_file_texts());
  throw InputError(fmt::format("{}: its report.json is of another version of the program", options.file));
}

/// The page of what kept_page_data gave; an exit code.
int page_of_data(const Json& data, const CommonOptions& options) {
  try {
    const std::string kind = data.at("kind");
    if (options.replays > 0)
      throw InputError(fmt::format(
          "--replays: goes with the folder of sweep, decide or optimise; {} is of another kind", options.file));
    const OutputFolder folder = folder_of(kind, options);
    const auto recording = kind == "run" ? recording_of_run(data, options) : std::string();
    if (!recording) return exit_interrupted;
    const bool with_simulator = kind == "run" && data.at("space") == "plane";
    folder.add({"report.html", filled_page(options.page_template(with_simulator), page_text(data), *recording)});
    return exit_done;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}/{}: was not written by vibrosow: {}", options.file, page_data_name, error.what()));
  }
}

/// The page of a study by the runs that are kept; an exit code.
int page_of_study(const CommonOptions& options, const std::string& page_template) {
  const StudyPlan plan = read_plan(options.file);
  StudyRuns runs(cases_of(options.file));
  if (const auto asked = adaptive_study(plan)) {
    const OutputFolder folder = asked->folder(options);
    RoundExecutor rounds(runs, std::nullopt, options.jobs, true);
    if (!asked->run_to_decision(rounds)) complain("warning: runs are missing");
    return add_page_with_replays(*asked, folder, runs, options, page_template, {});
  }
  const PlannedStudy planned = study_of_plan(plan);
  const OutputFolder folder = options.output_folder("sweep", sweep_file_texts());
  const StudyResult result = answer_of_kept(planned, runs.kept(), options.jobs);
  warn_of_lacking_runs(planned, result, options.file, options.jobs);
  return add_sweep_page_with_replays(planned, runs, folder, result, options, page_template);
}

int report(CommonOptions& options) {
  options.out = options.file;
  options.html = true;
  if (!std::filesystem::is_directory(options.file)) throw InputError(fmt::format("{}: is no folder", options.file));
  const auto data = kept_page_data(options.file);
  const int exit_code = data ? page_of_data(*data, options) : page_of_study(options, options.page_template());
  if (exit_code == exit_done && !options.quiet) print("{}/report.html\n", options.file);
  return exit_code;
}

}  // namespace

void add_report_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command = app.add_subcommand("report", "write the page report.html of a folder of results");
  command->add_option("FOLDER", options->file, "of run, sweep, decide, optimise, accuracy or calibrate")->required();
  add_replays_option(*command, *options);
  add_jobs_option(*command, *options);
  command->add_flag("--quiet", options->quiet, "no progress");
  add_examples(*command,
               {"vibrosow report 11-hz", "vibrosow report out/my-wheat-tray", "vibrosow report 11-hz --quiet"});
  command->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace vibrosow
