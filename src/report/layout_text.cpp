#include "report/layout_text.hpp"

#include <fmt/format.h>

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

std::string with_interval(const std::optional<MeanWithInterval>& value, double unit, std::string_view plus_minus) {
  if (!value) return "";
  const auto half_width = value->half_width_95 ? std::optional(*value->half_width_95 / unit) : std::nullopt;
  return interval_text(value->mean / unit, half_width, plus_minus);
}

}  // namespace vibrosow
