#include "report/run_data_check.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr double much = 1e15;   // in any unit of the page
constexpr double latest = 2e6;  // s, twice the longest run
constexpr double most_seeds = 1e15, most_in_list = 1e9;

enum class Holds { text, flag, number, list, object };

/// Of a key; * stands for each of a list. What is beneath a key that is null is not looked for. Members stand as rules
/// are written. NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding)
struct KeyRule {
  std::string_view path;
  Holds holds;
  double least = -much, most = much;  // of a number; of a list its length
  bool may_be_null = false, may_be_absent = false;
};

constexpr KeyRule length_of(std::string_view path) {
  return {path, Holds::number, 0, much};
}
constexpr KeyRule time_of(std::string_view path) {
  return {path, Holds::number, 0, latest};
}
constexpr KeyRule count_of(std::string_view path, double least = 0) {
  return {path, Holds::number, least, most_seeds};
}
constexpr KeyRule hole_of(std::string_view path, double first) {
  return {path, Holds::number, first, 1e6};
}
constexpr KeyRule or_null(KeyRule rule) {
  rule.may_be_null = true;
  return rule;
}
constexpr KeyRule or_absent(KeyRule rule) {
  rule.may_be_absent = true;
  return rule;
}

constexpr KeyRule run_rules[] = {{"program/name", Holds::text},
                                 {"program/version", Holds::text},
                                 {"title", Holds::text},
                                 {"space", Holds::text},
                                 {"headline", Holds::text},
                                 {"remarks/*/serious", Holds::flag},
                                 {"remarks/*/text", Holds::text},
                                 or_absent({"remarks/*/what_to_do", Holds::text}),
                                 or_absent({"expected", Holds::text}),
                                 {"status", Holds::text},
                                 {"random_seed", Holds::number, 0, 0x1p64},
                                 time_of("end_time_s"),
                                 {"window_s", Holds::list, 2, 2},
                                 time_of("window_s/*"),
                                 {"lots", Holds::list, 1, most_in_list},
                                 {"lots/*/name", Holds::text},
                                 length_of("lots/*/diameter_mm"),
                                 {"vessels", Holds::list, 1, 2},
                                 {"vessels/*/name", Holds::text},
                                 {"vessels/*/at_mm", Holds::list, 3, 3},
                                 {"vessels/*/at_mm/*", Holds::number},
                                 {"vessels/*/tilt_rad", Holds::number},
                                 length_of("vessels/*/length_mm"),
                                 length_of("vessels/*/height_mm"),
                                 or_null(length_of("vessels/*/depth_mm")),
                                 {"vessels/*/lines/*/points_mm/*", Holds::list, 2, 2},
                                 {"vessels/*/lines/*/points_mm/*/*", Holds::number},
                                 hole_of("vessels/*/holes/*/number", 1),
                                 {"vessels/*/holes/*/x_mm", Holds::number},
                                 {"vessels/*/holes/*/z_mm", Holds::number},
                                 length_of("vessels/*/holes/*/half_x_mm"),
                                 length_of("vessels/*/holes/*/half_z_mm"),
                                 {"vessels/*/holes/*/round", Holds::flag},
                                 {"faces", Holds::object},
                                 {"paths", Holds::object},
                                 hole_of("holes/*/hole", 1),
                                 count_of("holes/*/counted"),
                                 count_of("holes/*/counted_all"),
                                 or_null(count_of("holes/*/rate")),
                                 or_null(count_of("holes/*/rate_low")),
                                 or_null(count_of("holes/*/rate_high")),
                                 or_null(time_of("holes/*/longest_pause_s")),
                                 {"rate_unit", Holds::text},
                                 {"hole_table/columns/*/name", Holds::text},
                                 {"hole_table/columns/*/unit", Holds::text},
                                 {"hole_table/rows/*", Holds::list, 1, most_in_list},
                                 {"hole_table/rows/*/*", Holds::text},
                                 or_null({"unevenness", Holds::object}),
                                 {"unevenness/sentence", Holds::text},
                                 or_null(count_of("unevenness/cv_percent")),
                                 time_of("events/time_s/*"),
                                 hole_of("events/hole/*", 0),
                                 count_of("events/lot/*"),
                                 {"effects/*/name", Holds::text},
                                 {"effects/*/present", Holds::flag},
                                 {"effects/*/why", Holds::text},
                                 {"guard", Holds::text},
                                 {"settings/*/name", Holds::text},
                                 {"settings/*/value", Holds::text},
                                 or_null({"drill", Holds::object}),
                                 count_of("drill/rows/*/row", 1),
                                 or_null(count_of("drill/rows/*/kg_per_ha")),
                                 {"drill/sentence", Holds::text},
                                 {"scene", Holds::object}};

[[noreturn]] void refuse_key(const std::string& where, const std::string& what) {
  throw InputError(fmt::format("{} {}", where, what));
}

std::string_view type_name(Holds holds) {
  constexpr std::string_view names[] = {"text", "boolean", "number", "list", "object"};
  return names[static_cast<std::size_t>(holds)];
}

bool is_of_type(const Json& value, Holds holds) {
  switch (holds) {
    case Holds::text:
      return value.is_string();
    case Holds::flag:
      return value.is_boolean();
    case Holds::number:
      return value.is_number();
    case Holds::list:
      return value.is_array();
    case Holds::object:
      break;
  }
  return value.is_object();
}

void check_value(const Json& value, const KeyRule& rule, const std::string& where) {
  if (value.is_null() && rule.may_be_null) return;
  if (!is_of_type(value, rule.holds)) refuse_key(where, fmt::format("is no {}", type_name(rule.holds)));
  const bool is_list = rule.holds == Holds::list;
  if (!is_list && rule.holds != Holds::number) return;
  const double number = is_list ? static_cast<double>(value.size()) : value.get<double>();
  if (!(number >= rule.least && number <= rule.most))
    refuse_key(where, fmt::format("is no {} from {:g} to {:g}{}", is_list ? "list of" : "number", rule.least, rule.most,
                                  is_list ? " entries" : ""));
}

/// `where`: the way to `value` as a text.
void check_key(const Json& value, std::string_view path, const KeyRule& rule, std::string& where) {
  if (path.empty()) return check_value(value, rule, where);
  const std::size_t end = std::min(path.find('/'), path.size());
  const std::string key(path.substr(0, end));
  const std::string_view rest = path.substr(std::min(end + 1, path.size()));
  const std::size_t length = where.size();
  if (key == "*") {
    if (!value.is_array()) refuse_key(where, "is no list");
    for (std::size_t k = 0; k < value.size(); ++k) {
      where += '/' + std::to_string(k);
      check_key(value[k], rest, rule, where);
      where.resize(length);
    }
    return;
  }
  if (!value.is_object()) refuse_key(where, "is no object");
  where += (where.empty() ? "" : "/") + key;
  const auto found = value.find(key);
  if (found == value.end() && !rule.may_be_absent) refuse_key(where, "is missing");
  if (found != value.end() && (rest.empty() || !found->is_null())) check_key(*found, rest, rule, where);
  where.resize(length);
}

/// Whether all numbers in it are finite and such as a page has.
bool are_bounded(const Json& value) {
  if (value.is_number()) return std::abs(value.get<double>()) <= much;
  return !value.is_structured() || std::ranges::all_of(value, are_bounded);
}

}  // namespace

void check_run_data(const Json& data) {
  std::string where;
  for (const KeyRule& rule : run_rules) check_key(data, rule.path, rule, where);
  for (const char* key : {"lots", "faces", "paths"})
    if (!are_bounded(data.at(key))) refuse_key(key, fmt::format("has a number beyond {:g}", much));
  const Json& events = data.at("events");
  for (const char* key : {"hole", "lot"})
    if (events.at(key).size() != events.at("time_s").size())
      refuse_key(fmt::format("events/{}", key), "is not as long as events/time_s");
}

}  // namespace vibrosow
