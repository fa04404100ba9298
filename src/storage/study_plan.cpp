#include "storage/study_plan.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <queue>
#include <sstream>
#include <system_error>

#include "scene/input_error.hpp"
#include "storage/atomic_file.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path pointer_of(const fs::path& folder) {
  return cases_of(folder) / "plan";
}

std::string name_of(const std::string& content) {
  return fmt::format("{:016x}", XXH3_64bits(content.data(), content.size()));
}

/// A text, or the numbers of its bytes where it is not UTF-8, which JSON's texts must be.
Json text_or_bytes(const std::string& text) {
  try {
    static_cast<void>(Json(text).dump());
    return text;
  } catch (const Json::type_error&) {
    return Json(std::vector<std::uint8_t>(text.begin(), text.end()));
  }
}

std::string bytes_of(const nlohmann::json& json) {
  if (json.is_string()) return json;
  const auto bytes = json.get<std::vector<std::uint8_t>>();
  return {bytes.begin(), bytes.end()};
}

/// Whether a run stands in a plan right behind another: of the same layout, at the same cost, by the next random seed.
bool continues(const PlannedRun& run, const PlannedRun& before) {
  return run.layout == before.layout && run.grain_steps == before.grain_steps &&
         run.random_seed == before.random_seed + 1;
}

/// Runs that follow one another, in groups: their names as one text, since a plan may have a million of them.
Json groups_of(const std::vector<PlannedRun>& runs) {
  Json groups = Json::array();
  for (std::size_t from = 0, to = 0; from < runs.size(); from = to) {
    std::string names;
    do names += (names.empty() ? "" : " ") + runs[to++].name;
    while (to < runs.size() && continues(runs[to], runs[to - 1]));
    groups.push_back({{"layout", runs[from].layout},
                      {"random_seed", runs[from].random_seed},
                      {"grain_steps", runs[from].grain_steps},
                      {"cases", std::move(names)}});
  }
  return groups;
}

std::vector<PlannedRun> runs_in(const nlohmann::json& groups) {
  std::vector<PlannedRun> runs;
  for (const auto& group : groups) {
    PlannedRun run{{}, group.at("layout"), group.at("random_seed"), group.at("grain_steps")};
    std::istringstream names(group.at("cases").get<std::string>());
    for (; names >> run.name; ++run.random_seed) runs.push_back(run);
  }
  return runs;
}

std::string text_of(const StudyPlan& plan) {
  Json files = Json::object();
  for (const auto& [path, text] : plan.files) files[path] = text_or_bytes(text);
  Json json = {{"study", plan.study},
               {"set", plan.sets},
               {"random_seed", plan.random_seed},
               {"files", files},
               {"runs", groups_of(plan.runs)}};
  if (!plan.asked.empty()) json["asked"] = plan.asked;
  return json.dump(1) + '\n';
}

StudyPlan plan_in(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  StudyPlan plan{json.at("study"), json.at("set"), json.at("random_seed"), {}, {}};
  if (json.contains("asked")) plan.asked = json.at("asked").get<std::vector<std::string>>();
  for (const auto& [path, content] : json.at("files").items()) plan.files[path] = bytes_of(content);
  plan.runs = runs_in(json.at("runs"));
  return plan;
}

}  // namespace

fs::path cases_of(const fs::path& folder) {
  return folder / "cases";
}

fs::path plan_path(const fs::path& folder, const std::string& name) {
  return cases_of(folder) / "plans" / name;
}

std::string freeze_plan(const fs::path& folder, const StudyPlan& plan) {
  const std::string text = text_of(plan);
  std::string name = name_of(text);
  const fs::path file = plan_path(folder, name + ".json");
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) cannot_write(file, error.message());
  if (!fs::exists(file, error)) write_file_atomically(file, text);
  write_file_atomically(pointer_of(folder), name + '\n');
  return name;
}

std::string current_plan(const fs::path& folder) {
  std::ifstream pointer(pointer_of(folder));
  std::string name;
  if (!std::getline(pointer, name))
    throw InputError(fmt::format("{}: there is no cases/plan: not a folder of a sweep", folder.string()));
  return name;
}

StudyPlan read_plan(const fs::path& folder, std::string name) {
  if (name.empty()) name = current_plan(folder);
  const fs::path path = plan_path(folder, name + ".json");
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: there is no plan {}", folder.string(), name));
  const std::string text(std::istreambuf_iterator<char>(file), {});
  try {
    if (name_of(text) == name) return plan_in(text);
  } catch (const nlohmann::json::exception&) {
  }
  throw InputError(fmt::format("{}: is damaged, or was not written by vibrosow", path.string()));
}

std::vector<std::size_t> bundle_of(const StudyPlan& plan, std::size_t number, std::size_t bundles) {
  std::vector<std::size_t> dearest_first(plan.runs.size());
  std::iota(dearest_first.begin(), dearest_first.end(), std::size_t{0});
  std::ranges::stable_sort(dearest_first, std::greater{}, [&](std::size_t k) { return plan.runs[k].grain_steps; });
  using Share = std::pair<double, std::size_t>;  // its cost so far, its number
  std::priority_queue<Share, std::vector<Share>, std::greater<>> shares;
  for (std::size_t share = 1; share <= bundles; ++share) shares.emplace(0, share);
  std::vector<std::size_t> mine;
  for (const std::size_t run : dearest_first) {
    const auto [cost, share] = shares.top();
    shares.pop();
    if (share == number) mine.push_back(run);
    shares.emplace(cost + plan.runs[run].grain_steps, share);
  }
  std::ranges::sort(mine);
  return mine;
}

}  // namespace vibrosow
