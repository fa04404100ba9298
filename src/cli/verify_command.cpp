#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "storage/case_folder.hpp"
#include "storage/sweep_plan.hpp"

namespace vibrosow {
namespace {

/// Looks at every kept run; an exit code.
int verify(const std::string& folder) {
  read_plan(folder);
  const CaseFolder cases(cases_of(folder));
  std::size_t damaged = 0;
  const std::vector<std::string> names = cases.names();
  for (const std::string& name : names) {
    if (cases.named(name)) continue;
    ++damaged;
    print("damaged: {}\n", name);
  }
  print("{} runs, {} damaged{}\n", names.size(), damaged, damaged ? "; the same sweep again makes these anew" : "");
  return damaged ? exit_wrong_input : exit_done;
}

}  // namespace

void add_verify_command(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("verify", "read every run that a sweep has kept: is any damaged?");
  command->add_option("FOLDER", *folder, "of the sweep")->required();
  command->callback([folder, &exit_code] { exit_code = verify(*folder); });
}

}  // namespace vibrosow
