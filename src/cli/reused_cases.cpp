#include "cli/reused_cases.hpp"

#include <fmt/format.h>

#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"

namespace vibrosow {

void add_reuse_option(CLI::App& command, std::vector<std::string>& folders) {
  command.add_option("--reuse", folders, "folders of other studies, whose runs are used where they fit")
      ->delimiter(',')
      ->type_name("FOLDER");
}

std::vector<std::filesystem::path> cases_to_reuse(const std::vector<std::string>& folders) {
  std::vector<std::filesystem::path> cases;
  for (const std::string& folder : folders) {
    cases.push_back(cases_of(folder).path());
    if (!std::filesystem::is_directory(cases.back()))
      throw InputError(fmt::format("--reuse: {} holds no runs of a sweep", folder));
  }
  return cases;
}

}  // namespace vibrosow
