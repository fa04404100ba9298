#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "report/terminal_text.hpp"
#include "storage/case_folder.hpp"
#include "storage/sweep_plan.hpp"

namespace vibrosow {
namespace {

/// How far a sweep is, and what the guard stopped.
void print_status(const std::string& folder) {
  const SweepPlan plan = read_plan(folder);
  const CaseFolder cases(cases_of(folder));
  std::size_t kept = 0;
  std::map<std::string, int> stopped;  // by reason
  for (const std::string& name : plan.runs) {
    const auto one = cases.named(name);
    if (!one) continue;
    ++kept;
    if (one->run.status == RunStatus::stopped_by_guard) ++stopped[one->run.stop_reason];
  }
  print("{}\n{} of {} runs are there, {} are missing\n", plan.study, kept, plan.runs.size(), plan.runs.size() - kept);
  for (const auto& [reason, runs] : stopped)
    print_text(wrapped_beside(fmt::format("  {} stopped by the guard: ", runs), reason));
  if (kept < plan.runs.size()) print_text("the same sweep again makes those that are missing\n");
}

}  // namespace

void add_status_command(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("status", "how far a sweep is");
  command->add_option("FOLDER", *folder, "of the sweep")->required();
  command->callback([folder, &exit_code] {
    print_status(*folder);
    exit_code = exit_done;
  });
}

}  // namespace vibrosow
