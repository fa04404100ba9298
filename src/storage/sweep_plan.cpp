#include "storage/sweep_plan.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "scene/input_error.hpp"
#include "storage/atomic_file.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

fs::path plan_of(const fs::path& folder) {
  return cases_of(folder) / "plan.json";
}

}  // namespace

fs::path cases_of(const fs::path& folder) {
  return folder / "cases";
}

void write_plan(const fs::path& folder, const SweepPlan& plan) {
  const nlohmann::ordered_json json = {
      {"study", plan.study}, {"set", plan.sets}, {"random_seed", plan.random_seed}, {"runs", plan.runs}};
  std::error_code error;
  fs::create_directories(cases_of(folder), error);
  if (error) cannot_write(plan_of(folder), error.message());
  write_file_atomically(plan_of(folder), json.dump(1) + '\n');
}

SweepPlan read_plan(const fs::path& folder) {
  std::ifstream file(plan_of(folder));
  if (!file)
    throw InputError(fmt::format("{}: there is no {}: not a folder of a sweep", folder.string(), "cases/plan.json"));
  try {
    const auto json = nlohmann::json::parse(file);
    return {json.at("study"), json.at("set"), json.at("random_seed"), json.at("runs")};
  } catch (const nlohmann::json::exception&) {
    throw InputError(fmt::format("{}: was not written by vibrosow sweep", plan_of(folder).string()));
  }
}

}  // namespace vibrosow
