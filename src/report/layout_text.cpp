#include "report/layout_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "input/key_units.hpp"
#include "report/csv.hpp"
#include "report/number_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

/// A value of a layout as a person writes it: "9 Hz".
std::string with_unit(const std::string& key, const std::string& value) {
  const auto unit = column_unit(key);
  return unit && csv_text_or_number(value).is_number ? fmt::format("{} {}", value, unit->unit) : value;
}

}  // namespace

std::string described(const Study& study, const Layout& layout) {
  std::string text = layout.name;
  for (const std::string& key : study.keys) {
    const auto value = layout.values.find(key);
    const bool is_told = !layout.name.empty() && std::ranges::find(study.varied, key) == study.varied.end();
    if (value == layout.values.end() || is_told) continue;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", key.substr(key.rfind('.') + 1), with_unit(key, value->second));
  }
  return text;
}

std::string_view unit_of(const Metric& metric) {
  return metric.unit == "1/s" ? "seeds/s" : metric.unit;
}

std::string counted_standings(const Answer& answer, const std::function<bool(const AnsweredLayout&)>& is_told) {
  std::map<LayoutStanding, int> counts;
  for (const AnsweredLayout& one : answer.layouts)
    if (!is_told(one)) ++counts[one.standing];
  std::string text;
  for (const auto& [standing, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(standing));
  return text;
}

std::string edge_text(const std::vector<std::string>& keys) {
  if (keys.empty()) return "";
  std::string names;
  for (const std::string& key : keys)
    names += fmt::format("{}{}", names.empty() ? "" : " and ", key.substr(key.rfind('.') + 1));
  return fmt::format("at the end of the range of {}: better ones may lie beyond", names);
}

std::string with_interval(const std::optional<MeanWithInterval>& value, double unit, std::string_view plus_minus) {
  if (!value) return "";
  const auto half_width = value->half_width_95 ? std::optional(*value->half_width_95 / unit) : std::nullopt;
  return interval_text(value->mean / unit, half_width, plus_minus);
}

}  // namespace vibrosow
