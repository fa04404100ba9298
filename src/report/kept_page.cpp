#include "report/kept_page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "report/page.hpp"
#include "report/run_data_check.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// Throws Json::exception for what the program has not written.
void add_times(Json& data, const Json& times) {
  Json& levels = data.at("levels");
  const Json& of_levels = times.at("setting_cpu_s");
  for (std::size_t i = 0; i < levels.size(); ++i) levels.at(i)["cpu_s"] = of_levels.at(i);
  if (const std::string cost = times.at("cost"); !cost.empty()) data.at("headlines").push_back(cost);
}

}  // namespace

std::vector<OutputFile> timed_page_files(const std::string& page_template, const std::string& data,
                                         const std::string& times) {
  std::vector<OutputFile> files = page_files("", data);
  if (page_template.empty()) return files;
  Json timed = Json::parse(data);
  add_times(timed, Json::parse(times));
  files.push_back({"report.html", filled_page(page_template, page_text(timed), {})});
  return files;
}

std::optional<Json> kept_page_data(const std::filesystem::path& folder) {
  const auto text = text_of_file_or_none(folder / page_data_name);
  if (!text) return std::nullopt;
  std::filesystem::path read = folder / page_data_name;
  try {
    Json data = parse_json<Json>(*text);
    if (data.at("kind") == "run") check_run_data(data);
    if (data.at("kind") != "accuracy") return data;
    read = folder / page_times_name;
    if (const auto times = text_of_file_or_none(read)) add_times(data, parse_json<Json>(*times));
    return data;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: was not written by vibrosow: {}", read.string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: was not written by this version of vibrosow: {}", read.string(), error.what()));
  }
}

}  // namespace vibrosow
