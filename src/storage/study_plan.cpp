#include "storage/study_plan.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <climits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <queue>
#include <sstream>

#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr std::size_t plan_digits = 16, case_digits = 32;
constexpr double most_grain_steps = 1e30;

PathInFolder pointer_of(const fs::path& folder) {
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
    PlannedRun run{{},
                   static_cast<int>(whole_number(group.at("layout"), 1, INT_MAX)),
                   seed_number(group.at("random_seed")),
                   number_within(group.at("grain_steps"), 0, most_grain_steps)};
    std::istringstream names(group.at("cases").get<std::string>());
    for (; names >> run.name; ++run.random_seed) {
      if (!is_hash_name(run.name, case_digits)) throw InputError("a run's name is none of a case");
      runs.push_back(run);
    }
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
  if (!command_of(plan.question).empty()) json["question"] = json_of(plan.question);
  return json.dump(1) + '\n';
}

struct OtherVersion {};

/// Throws OtherVersion where a question stands there as words.
StudyPlan plan_in(const std::string& text) {
  const auto json = parse_json<nlohmann::json>(text);
  if (json.contains("asked")) throw OtherVersion();
  StudyPlan plan{json.at("study"), json.at("set"), seed_number(json.at("random_seed")), {}, {}};
  if (json.contains("question")) plan.question = question_in(json.at("question"));
  for (const auto& [path, content] : json.at("files").items()) plan.files[path] = bytes_of(content);
  plan.runs = runs_in(json.at("runs"));
  return plan;
}

}  // namespace

bool are_of_one_study(const StudyPlan& one, const StudyPlan& other) {
  return one.study == other.study && one.sets == other.sets && one.random_seed == other.random_seed &&
         one.files == other.files && one.question == other.question;
}

PathInFolder cases_of(const fs::path& folder) {
  return PathInFolder(folder) / "cases";
}

PathInFolder plan_file(const fs::path& folder, const std::string& name) {
  return cases_of(folder) / "plans" / name;
}

std::string freeze_plan(const fs::path& folder, const StudyPlan& plan) {
  const std::string text = text_of(plan);
  std::string name = name_of(text);
  const PathInFolder file = plan_file(folder, name + ".json");
  make_directories(cases_of(folder) / "plans", file.path());
  if (text_of_file(file.path()) != text) write_file_atomically(file, text);  // also where it was cut short
  write_file_atomically(pointer_of(folder), name + '\n');
  return name;
}

std::string current_plan(const fs::path& folder) {
  constexpr std::size_t most = 1000;  // bytes
  std::string name = text_of_file_or_none(pointer_of(folder).path(), most).value_or("");
  if (name.empty())
    throw InputError(
        fmt::format("{}: holds no results: neither report.json nor cases/plan, a study's", folder.string()));
  if (name.ends_with('\n')) name.pop_back();
  if (!is_hash_name(name, plan_digits))
    throw InputError(fmt::format("{}: is damaged: it holds no plan's name", pointer_of(folder).path().string()));
  return name;
}

StudyPlan read_plan(const fs::path& folder, std::string name) {
  if (name.empty()) name = current_plan(folder);
  if (!is_hash_name(name, plan_digits))
    throw InputError(fmt::format("a plan is named by {} of the digits 0 to 9 and a to f, not by \"{}\"", plan_digits,
                                 name.substr(0, 2 * plan_digits)));
  const fs::path path = plan_file(folder, name + ".json").path();
  const std::optional<std::string> text = text_of_file_or_none(path);
  if (!text) throw InputError(fmt::format("{}: there is no plan {}", folder.string(), name));
  try {
    if (name_of(*text) == name) return plan_in(*text);
  } catch (const OtherVersion&) {
    throw InputError(
        fmt::format("{}: its plan was made by another version of the program; the same command again makes a new one "
                    "and takes the runs that are there",
                    folder.string()));
  } catch (const nlohmann::json::exception&) {
  } catch (const InputError&) {  // what stands there is no plan's
  }
  throw InputError(fmt::format("{}: is damaged, or was not written by vibrosow", path.string()));
}

std::vector<std::size_t> shard_of(const StudyPlan& plan, std::size_t number, std::size_t shards) {
  std::vector<std::size_t> by_descending_cost(plan.runs.size());
  std::iota(by_descending_cost.begin(), by_descending_cost.end(), std::size_t{0});
  std::ranges::stable_sort(by_descending_cost, std::greater{}, [&](std::size_t k) { return plan.runs[k].grain_steps; });
  using Share = std::pair<double, std::size_t>;  // its cost so far, its number
  std::priority_queue<Share, std::vector<Share>, std::greater<>> shares;
  for (std::size_t share = 1; share <= shards; ++share) shares.emplace(0, share);
  std::vector<std::size_t> mine;
  for (const std::size_t run : by_descending_cost) {
    const auto [cost, share] = shares.top();
    shares.pop();
    if (share == number) mine.push_back(run);
    shares.emplace(cost + plan.runs[run].grain_steps, share);
  }
  std::ranges::sort(mine);
  return mine;
}

}  // namespace vibrosow
