#include "input/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace vibrosow {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  constexpr std::size_t shortest_part = 3;
  std::size_t best_distance = (word.size() + 2) / 3 + 1;  // farther than this is another word
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  if (best || word.size() < shortest_part) return best;
  for (const std::string& candidate : known)
    if (candidate.size() >= shortest_part &&
        (candidate.find(word) != std::string::npos || word.find(candidate) != std::string_view::npos))
      return candidate;
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::optional<std::string> meant = nearest(word, known);
  return meant ? fmt::format("; did you mean \"{}\"?", *meant) : "";
}

std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 120;
  return text.size() <= longest ? std::string(text) : fmt::format("{}...", text.substr(0, longest));
}

std::string shown(double value, Dimension dimension, const std::string& unit) {
  switch (dimension) {
    case Dimension::length:
      return value < 0.1 && value > -0.1 && value != 0 ? fmt::format("{:g} mm", value * 1000)
                                                       : fmt::format("{:g} m", value);
    case Dimension::angle:
      return fmt::format("{:g} degree", value * 180 / std::numbers::pi);
    case Dimension::fraction:
      return fmt::format("{:g} %", value * 100);
    default:
      return fmt::format("{:g} {}", value / unit_size(unit, dimension), unit);
  }
}

}  // namespace vibrosow
