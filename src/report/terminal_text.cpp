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

std::string two_digit_percent(double fraction) {
  return to_digits(100 * fraction, 2);
}

std::string_view of_plane(Space space) {
  return space == Space::two_dimensional
             ? " (2D: a slice's rate times the depth; its holes are slots from front to back)"
             : "";
}

std::string unevenness_text(const Unevenness& of) {
  if (!of.cv) return fmt::format("below {} % (95 %)", to_digits(100 * of.high, 2));
  return fmt::format("{} % ({} to {} %)", to_digits(100 * *of.cv, 2), to_digits(100 * of.low, 2),
                     to_digits(100 * of.high, 2));
}

std::string unevenness_sentence(const Unevenness& of, std::string_view what) {
  const std::string text = of.cv ? fmt::format("unevenness (CV) between {}s {}", what, unevenness_text(of))
                                 : fmt::format("too few seeds to tell any {} from the others: unevenness (CV) {}", what,
                                               unevenness_text(of));
  return text + "; from blocks of one run, which do not show how random seeds differ";
}

std::string window_sentence(const MeasuringWindow& window, double written_from) {
  std::string text = fmt::format("measured from {:.6g} s", window.from);
  if (window.from != written_from) text += fmt::format(" (run.measure_from is {:g} s)", written_from);
  text += fmt::format(" to {:.6g} s", window.to);
  if (window.drive == MeasuringWindow::Drive::aperiodic)
    return text + ": the drive is a table, of which whole periods are not known";
  if (window.drive == MeasuringWindow::Drive::still || window.periods == 0) return text;
  return text + fmt::format(": {} whole period{} of the drive", window.periods, window.periods == 1 ? "" : "s");
}

}  // namespace vibrosow
