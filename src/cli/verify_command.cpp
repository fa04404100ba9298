#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "storage/case_folder.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

/// Names of kept runs that cannot be read.
struct Unreadable {
  std::vector<std::string> damaged, of_other_version;
};
Unreadable unreadable_in(const CaseFolder& cases) {
  Unreadable unreadable;
  for (const std::string& name : cases.names())
    if (!cases.named(name))
      (cases.is_of_other_version(name) ? unreadable.of_other_version : unreadable.damaged).push_back(name);
  return unreadable;
}

/// Looks at every kept run and makes those that cannot be read anew; an exit code.
int verify(const std::string& folder) {
  const StudyPlan plan = read_plan(folder);
  const CaseFolder cases(cases_of(folder));
  const auto [damaged, of_other_version] = unreadable_in(cases);
  print("{} runs, {} damaged{}\n", cases.names().size(), damaged.size(),
        of_other_version.empty() ? "" : fmt::format(", {} of another version of the program", of_other_version.size()));
  for (const std::string& segment : cases.unreadable_segments())
    complain(fmt::format("warning: {}: is damaged; the runs that it held are missing", segment));
  for (const std::string& name : damaged) print("damaged: {}\n", name);
  for (const std::string& name : of_other_version) print("of another version: {}\n", name);
  std::vector<std::string> unreadable = damaged;
  unreadable.insert(unreadable.end(), of_other_version.begin(), of_other_version.end());
  if (unreadable.empty()) return exit_done;
  const PlannedStudy planned = study_of_plan(plan);
  std::vector<std::size_t> again;
  for (const std::string& name : unreadable) {
    cases.remove(name);
    const auto run = std::ranges::find(plan.runs, name, &PlannedRun::name);
    if (run != plan.runs.end()) again.push_back(static_cast<std::size_t>(run - plan.runs.begin()));
  }
  StudyRuns runs(cases_of(folder));
  const BatchResult made = make_runs(runs, wanted_runs(planned, again), {}, 1, true);
  check_that_all_are_kept(runs);
  print("{} made again; {} belong to no run of the plan and were removed\n", made.batch.made,
        unreadable.size() - again.size());
  return made.batch.interrupted > 0 ? exit_interrupted : exit_done;
}

}  // namespace

void add_verify_command(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("verify", "check every kept run of a sweep, and make damaged ones again");
  command->add_option("FOLDER", *folder, "of the sweep")->required();
  add_examples(*command, {"vibrosow verify out/wheat-demo", "vibrosow verify best", "vibrosow verify there"});
  command->callback([folder, &exit_code] { exit_code = verify(*folder); });
}

void add_pack_command(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("pack", "pack a sweep's kept runs into few large files");
  command->add_option("FOLDER", *folder, "of the sweep")->required();
  add_examples(*command, {"vibrosow pack out/wheat-demo", "vibrosow pack best", "vibrosow pack there"});
  command->callback([folder, &exit_code] {
    current_plan(*folder);
    print("{} runs packed\n", CaseFolder(cases_of(*folder)).pack());
    exit_code = exit_done;
  });
}

}  // namespace vibrosow
