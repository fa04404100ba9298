#include "report/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace vibrosow {
namespace {

constexpr const char* narrow_space = "\u202f";  // breaks no line

/// Of a number's digits, "-12345.6".
std::string with_thousands_apart(std::string digits) {
  const std::size_t begin = digits.starts_with('-') ? 1 : 0, end = std::min(digits.find('.'), digits.size());
  if (end - begin < 5) return digits;
  for (std::size_t at = end - 3; at > begin; at = at > begin + 3 ? at - 3 : begin) digits.insert(at, narrow_space);
  return digits;
}

/// Rounded to a place: 10^`place`.
std::string at_place(double value, int place) {
  if (place < 0) return with_thousands_apart(fmt::format("{:.{}f}", value, std::min(-place, 12)));
  const double unit = std::strtod(fmt::format("1e{}", place).c_str(), nullptr);
  return with_thousands_apart(fmt::format("{:.0f}", std::round(value / unit) * unit));
}

/// Of the first digit of `value` rounded to `digits` of them.
int place_of(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  return static_cast<int>(std::strtol(text.c_str() + text.find('e') + 1, nullptr, 10));
}

}  // namespace

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0) return "0";
  std::string text = at_place(value, place_of(value, digits) - digits + 1);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string interval_text(double mean, const std::optional<double>& half_width, std::string_view plus_minus) {
  if (!half_width || !std::isfinite(*half_width) || !std::isfinite(mean)) return number_text(mean);
  constexpr double rounding = 1e-9;  // what is left of equal values
  if (*half_width <= rounding * std::abs(mean)) return fmt::format("{} {} 0", number_text(mean), plus_minus);
  const int place = place_of(*half_width, 2) - 1;
  return fmt::format("{} {} {}", at_place(mean, place), plus_minus, at_place(*half_width, place));
}

std::string count_text(double count) {
  if (count >= 999.5e6) return number_text(count / 1e9) + " billion";
  return count >= 999.5e3 ? number_text(count / 1e6) + " million" : number_text(count);
}

std::string time_text(double seconds) {
  constexpr std::array<std::pair<double, const char*>, 3> units = {{{1, "s"}, {1e-3, "ms"}, {1e-6, "µs"}}};
  for (const auto& [unit, name] : units)
    if (std::abs(seconds) >= 0.1 * unit || seconds == 0) return fmt::format("{} {}", number_text(seconds / unit), name);
  return fmt::format("{} µs", number_text(seconds * 1e6));
}

}  // namespace vibrosow
