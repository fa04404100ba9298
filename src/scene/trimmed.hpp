#pragma once

#include <string_view>

namespace vibrosow {

/// Without the blanks and ends of lines on either side.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const std::size_t from = text.find_first_not_of(blank);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blank) + 1 - from);
}

}  // namespace vibrosow
