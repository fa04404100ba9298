#include <fmt/format.h>

#include <charconv>
#include <csignal>
#include <memory>
#include <string>
#include <utility>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "cli/report_study.hpp"
#include "cli/slurm.hpp"
#include "input/wording.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

struct WorkOptions {
  std::string folder, plan, shard = "1/1";  // plan: empty is the current one
  BatchFlags batch;
  int jobs = 1;
  bool quiet = false, requeue = false;
};

/// "17/200".
std::pair<std::size_t, std::size_t> shard_numbers(const std::string& text) {
  std::size_t number = 0, shards = 0;
  const char *const begin = text.data(), *const end = begin + text.size();
  const auto [slash, none] = std::from_chars(begin, end, number);
  if (none == std::errc{} && slash != end && *slash == '/') {
    const auto [last, error] = std::from_chars(slash + 1, end, shards);
    if (error == std::errc{} && last == end && 1 <= number && number <= shards && shards <= 1000000)
      return {number, shards};
  }
  throw InputError(fmt::format("--shard: \"{}\" is no share such as 17/200", shortened(text)));
}

/// After the last of all shards: whether the wanted interval needs more.
void tell_of_more_runs(const PlannedStudy& planned, const WorkOptions& options) {
  if (!planned.study.replicates.interval || missing_runs(options.folder, planned.plan.runs) > 0) return;
  const std::string more = more_runs_needed(planned, options.folder, options.jobs);
  if (!more.empty()) print_text(wrapped(more));
}

int work(const WorkOptions& options) {
  const auto [number, shards] = shard_numbers(options.shard);
  const PlannedStudy planned = study_of_plan(read_plan(options.folder, options.plan));
  StudyRuns runs(cases_of(options.folder));
  const BatchResult made = make_runs(runs, wanted_runs(planned, shard_of(planned.plan, number, shards)), options.batch,
                                     options.jobs, options.quiet);
  const BatchSummary& batch = made.batch;
  if (!options.quiet)
    print("shard {}/{}: {} runs made, {} were there, {} left\n", number, shards, batch.made, batch.there,
          batch.interrupted);
  check_that_all_are_kept(runs);
  if (!options.quiet && options.plan.empty()) tell_of_more_runs(planned, options);
  if (batch.interrupted == 0) return exit_done;
  if (options.requeue) {
    std::signal(SIGTERM, SIG_IGN);  // Slurm sends it as soon as the job is taken back
    output_error();                 // what was printed is out before
    requeue_in_slurm();
  }
  return exit_interrupted;
}

}  // namespace

void add_work_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<WorkOptions>();
  CLI::App* command =
      app.add_subcommand("work", "make the runs of a sweep's plan, or a share of them, without reports");
  command->add_option("FOLDER", options->folder, "of the sweep")->required();
  command->add_option("--shard", options->shard, "share of the runs: 17/200 is the 17th of 200 shares of equal cost")
      ->type_name("K/N");
  command->add_option("--plan", options->plan, "an older plan of the folder, by its name")->type_name("NAME");
  command->add_option("--time-limit", options->batch.time_limit, "clock time after which unfinished runs are saved")
      ->type_name("TIME");
  command->add_option("--jobs", options->jobs, "runs in parallel")
      ->type_name("N")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  add_making_flags(*command, options->batch);
  command->add_flag("--requeue", options->requeue, "under Slurm: queue this job again while its share is unfinished");
  command->add_flag("--quiet", options->quiet, "no progress and no summary");
  add_examples(*command, {"vibrosow work there --shard 1/2", "vibrosow work there --shard 2/2 --jobs 2",
                          "vibrosow work there --time-limit \"1 min\""});
  command->callback([options, &exit_code] { exit_code = work(*options); });
}

}  // namespace vibrosow
