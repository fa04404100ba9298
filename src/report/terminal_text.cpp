#include "report/terminal_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace vibrosow {

std::string wrapped(std::string_view text, std::size_t indent) {
  std::string lines, line;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string_view word = text.substr(from, to - from);
    if (!line.empty() && indent + line.size() + 1 + word.size() > terminal_columns) {
      lines += std::string(indent, ' ') + line + '\n';
      line.clear();
    }
    if (!line.empty()) line += ' ';
    line += word;
    from = to + 1;
  }
  return lines + std::string(indent, ' ') + line + '\n';
}

std::string wrapped_beside(std::string_view label, std::string_view text) {
  return std::string(label) + wrapped(text, label.size()).substr(label.size());
}

std::string to_digits(double value, int digits) {
  constexpr double readable = 1e6;
  std::string text = fmt::format("{:.{}g}", value, digits);
  if (text.find("e+") == std::string::npos || std::abs(value) >= readable) return text;
  return fmt::format("{:.0f}", std::strtod(text.c_str(), nullptr));
}

std::string evenness_sentence(const Evenness& even, std::string_view between) {
  const std::string parts =
      fmt::format("raw CV {:.3g} %, of which counting alone {:.3g} %", 100 * even.raw_cv, 100 * even.counting_cv);
  if (!even.cv)
    return fmt::format("between {}: {}; so few seeds show no difference, which may be up to {:.3g} %", between, parts,
                       100 * even.high);
  return fmt::format("between {}: CV {:.3g} %, 95 % interval {:.3g} to {:.3g} % ({})", between, 100 * *even.cv,
                     100 * even.low, 100 * even.high, parts);
}

}  // namespace vibrosow
