#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/report_study.hpp"
#include "cli/slurm.hpp"
#include "files/atomic_file.hpp"
#include "input/input_file.hpp"
#include "report/sweep_report.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"
#include "study/predicted_cost.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

struct SubmitOptions {
  CommonOptions common;
  std::string time, partition;
  std::size_t shards = 0;  // 0: by predicted cost
  int array_limit = 0;     // 0: none
  bool dry_run = false, rounds = false;
};

/// A plan in its folder.
struct Frozen {
  PlannedStudy planned;
  fs::path folder;   // absolute
  std::string name;  // of the plan
};

/// A script's directives are lines, and Slurm has no way to quote what would end one. Throws InputError.
void refuse_in_script(const std::string& what, const std::string& text) {
  const bool fits = std::ranges::none_of(text, [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x20 || byte == 0x7f || std::string_view("\"'`\\").find(letter) != std::string_view::npos;
  });
  if (!fits)
    throw InputError(fmt::format(
        "{} \"{}\": control characters, quotes and backslashes cannot stand in a script for Slurm; rename it", what,
        printable(text)));
}

/// The current plan of a folder; where all its runs are there and its wanted interval needs more, the plan of these.
Frozen begun(const fs::path& folder) {
  PlannedStudy planned = study_of_plan(read_plan(folder));
  std::optional<PlannedStudy> next;
  if (planned.study.replicates.interval && missing_runs(folder, planned.plan.runs) == 0)
    next = next_round(planned, StudyRuns(cases_of(folder)).kept(), 1);
  if (!next) return {std::move(planned), folder, current_plan(folder)};
  std::string name = freeze_plan(folder, next->plan);
  return {std::move(*next), folder, std::move(name)};
}

Frozen freeze(const SubmitOptions& options) {
  const CommonOptions& common = options.common;
  refuse_in_script("the folder", fs::current_path().string());
  refuse_in_script("the file", common.file);
  refuse_in_script("--out", common.out);
  refuse_in_script("--partition", options.partition);
  refuse_in_script("the program", fs::read_symlink("/proc/self/exe").string());
  if (fs::is_directory(common.file)) {
    if (!common.sets.empty() || !common.out.empty())
      throw InputError("--set and --out go with a study, not with the folder of one that is begun");
    return begun(fs::canonical(common.file));
  }
  const InputFile file = input_file(common.file, FileKind::study);
  PlannedStudy planned = plan_study(file.path, common.sets, common.random_seed, file.files);
  print_warnings(study_warnings(planned.study));
  tell_of_files(file);
  const OutputFolder folder = common.output_folder("sweep", sweep_file_texts());
  std::string name = begin_study(folder, planned.plan, common.quiet);
  return {std::move(planned), fs::canonical(folder.path()), std::move(name)};
}

/// How long before its end (s) a job of `time` (s) is told to save what it is at.
double margin_of(double time) {
  return std::min(180.0, time / 8);
}

/// As many that each takes 10 to 60 minutes, well within a job's time.
std::size_t shards_of(const SubmitOptions& options, const PlannedStudy& planned, double time) {
  const std::size_t most = planned.plan.runs.size();
  if (options.shards > 0) return std::min(options.shards, most);
  const double target = std::min(std::clamp(0.6 * time, 600.0, 3600.0), time - margin_of(time));
  const double shards = std::ceil(predict_seconds(planned.study) / target);
  return static_cast<std::size_t>(std::clamp(shards, 1.0, static_cast<double>(most)));
}

std::string directive(const std::string& option) {
  return "#SBATCH " + option + "\n";
}

/// In whole minutes.
std::string time_directive(double time) {
  return directive(fmt::format("--time={:.0f}", std::ceil(time / 60)));
}

/// A file's name as Slurm reads it in a directive.
std::string without_patterns(const std::string& path) {
  std::string text;
  for (const char letter : path) text += letter == '%' ? "%%" : std::string(1, letter);
  return text;
}

/// What both scripts begin with.
std::string script_head(const SubmitOptions& options, const Frozen& frozen, const std::string& job,
                        const std::string& log) {
  refuse_in_script("the folder", frozen.folder.string());
  std::string text = "#!/bin/bash\n";
  text += directive(fmt::format("--job-name={}", job));
  text += directive(
      fmt::format("--output=\"{}/{}\"", without_patterns((cases_of(frozen.folder) / "logs").path().string()), log));
  text += directive("--open-mode=append");
  text += directive("--ntasks=1") + directive("--cpus-per-task=1");
  if (!options.partition.empty()) text += directive("--partition=" + options.partition);
  return text;
}

std::string program() {
  return shell_quoted(fs::read_symlink("/proc/self/exe").string());
}

std::string array_script(const SubmitOptions& options, const Frozen& frozen, std::size_t shards, double time) {
  const double margin = margin_of(time);
  std::string text = script_head(options, frozen, "vibrosow", "%A_%a.out");
  text += directive(
      fmt::format("--array=1-{}{}", shards, options.array_limit > 0 ? fmt::format("%{}", options.array_limit) : ""));
  text += time_directive(time);
  text += directive(fmt::format("--signal=B:TERM@{:.0f}", margin));
  text += directive("--requeue");
  return text + fmt::format(
                    "exec {} work {} --plan {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --time-limit \"{:.0f} s\" "
                    "--requeue\n",
                    program(), shell_quoted(frozen.folder.string()), frozen.name, shards, time - margin);
}

std::string export_script(const SubmitOptions& options, const Frozen& frozen, double time) {
  return script_head(options, frozen, "vibrosow-export", "%j.out") + time_directive(time) +
         fmt::format("exec {} export {} --complete\n", program(), shell_quoted(frozen.folder.string()));
}

/// A job that lasts as long as the study: it submits an array a round, waits for it and decides about the next.
std::string controller_script(const SubmitOptions& options, const Frozen& frozen) {
  std::string words;
  if (!options.partition.empty()) words += " --partition " + shell_quoted(options.partition);
  if (options.array_limit > 0) words += fmt::format(" --array-limit {}", options.array_limit);
  if (options.shards > 0) words += fmt::format(" --shards {}", options.shards);
  return script_head(options, frozen, "vibrosow-rounds", "%j.out") +
         fmt::format("exec {} submit {} --time {} --rounds{}\n", program(), shell_quoted(frozen.folder.string()),
                     shell_quoted(options.time), words);
}

/// Writes a plan's script and gives its name.
std::string write_script(const Frozen& frozen, const std::string& kind, const std::string& script) {
  const PathInFolder logs = cases_of(frozen.folder) / "logs", file = plan_file(frozen.folder, frozen.name + kind);
  make_directories(logs, logs.path());
  write_file_atomically(file, script);
  return file.path().string();
}

/// The controller's work: rounds until nothing more is needed, then the reports.
int submit_rounds(const SubmitOptions& options, double time) {
  Frozen frozen = freeze(options);
  StudyRuns runs(cases_of(frozen.folder));
  while (true) {
    const std::size_t shards = shards_of(options, frozen.planned, time);
    submit_to_slurm(write_script(frozen, ".sbatch", array_script(options, frozen, shards, time)), {"--wait"});
    std::optional<PlannedStudy> next = next_round(frozen.planned, runs.kept(), 1);
    if (!next) break;
    frozen.planned = std::move(*next);
    frozen.name = freeze_plan(frozen.folder, frozen.planned.plan);
    print("the next round has {} runs\n", frozen.planned.plan.runs.size());
  }
  CommonOptions reports = options.common;
  reports.out = frozen.folder.string();
  return report_study(frozen.planned, runs, reports.output_folder("sweep", sweep_file_texts()), {}, reports,
                      std::string());
}

int submit(const SubmitOptions& options) {
  const double time = time_option("--time", options.time);
  if (time < 120) throw InputError("--time: a job of less than 2 min is over before Slurm can warn it");
  if (options.rounds) return submit_rounds(options, time);
  const Frozen frozen = freeze(options);
  if (frozen.planned.study.replicates.interval) {
    const std::string script = controller_script(options, frozen);
    if (options.dry_run)
      print_text(script);
    else
      print("job {} submits an array a round\nvibrosow status {}\n",
            submit_to_slurm(write_script(frozen, ".rounds.sbatch", script), {}), frozen.folder.string());
    return exit_done;
  }
  const std::size_t shards = shards_of(options, frozen.planned, time);
  const std::string array = array_script(options, frozen, shards, time), after = export_script(options, frozen, time);
  if (options.dry_run) {
    print("{}\n{}", array, after);
    return exit_done;
  }
  const std::string job = submit_to_slurm(write_script(frozen, ".sbatch", array), {});
  const std::string export_job =
      submit_to_slurm(write_script(frozen, ".export.sbatch", after), {"--dependency=afterany:" + job});
  print("job {}: {} shards of {} runs; job {} makes the reports\n", job, shards, frozen.planned.plan.runs.size(),
        export_job);
  print("vibrosow status {}\n", frozen.folder.string());
  return exit_done;
}

}  // namespace

void add_submit_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SubmitOptions>();
  CLI::App* command = app.add_subcommand("submit", "run a sweep on a Slurm cluster, in shards, then write its reports");
  add_input_options(*command, options->common, "study file (.toml), or the folder of one that is begun");
  command->add_option("--out", options->common.out, "directory for the reports; default out/ and the file's name")
      ->type_name("DIR");
  add_random_seed_option(*command, options->common);
  command->add_option("--time", options->time, "time limit of a job, such as \"1 h\"")->type_name("TIME")->required();
  command->add_option("--shards", options->shards, "number of jobs in the array; default: jobs of 10 to 60 minutes")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command->add_option("--partition", options->partition, "of Slurm")->type_name("NAME");
  command->add_option("--array-limit", options->array_limit, "largest number of jobs at a time")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command->add_flag("--rounds", options->rounds, "submit round after round and wait, for adaptive replicates")
      ->group("");
  command->add_flag("--dry-run", options->dry_run, "write the plan and print the scripts, but submit nothing");
  add_examples(*command, {"vibrosow submit wheat-demo --time \"1 h\" --dry-run --out there",
                          "vibrosow submit wheat-demo --time \"1 h\" --shards 4 --dry-run --out there",
                          "vibrosow submit wheat-demo --time \"1 h\" --partition short --dry-run --out q"});
  command->callback([options, &exit_code] { exit_code = submit(*options); });
}

}  // namespace vibrosow
