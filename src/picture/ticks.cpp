#include "picture/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace vibrosow {
namespace {

constexpr double nearly = 1e-9;  // of a step: rounding makes no further tick

/// The next 1, 2 or 5 times a power of ten.
double step_above(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + nearly));
  for (const double factor : {1.0, 2.0, 5.0})
    if (value <= factor * power * (1 + nearly)) return factor * power;
  return 10 * power;
}

/// The double nearest to its decimals: 0.3 for 3 times 0.1.
double rounded(double value) {
  return std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr);
}

}  // namespace

Ticks linear_ticks(double low, double high, int most) {
  if (low > high) std::swap(low, high);
  const double span = high - low > 0 ? high - low : std::max(std::abs(high), std::abs(low));
  const double step = step_above((span > 0 ? span : 1.0) / most);
  const double first = std::floor(low / step + nearly), last = std::max(first + 1, std::ceil(high / step - nearly));
  Ticks ticks{rounded(first * step), rounded(last * step), {}};
  for (double k = first; k <= last; ++k) ticks.at.push_back(rounded(k * step) + 0.0);  // no -0
  return ticks;
}

Ticks logarithmic_ticks(double low, double high) {
  if (low > high) std::swap(low, high);
  const double first = std::floor(std::log10(low) + nearly);
  const double last = std::max(first + 1, std::ceil(std::log10(high) - nearly));
  const bool is_short = last - first <= 2;
  Ticks ticks{};
  for (double k = first; k <= last; ++k)
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor == 1 || (is_short && k < last)) ticks.at.push_back(rounded(factor * std::pow(10, k)));
  const auto is_needed = [&](std::size_t k) {
    const bool is_below = k + 1 < ticks.at.size() && ticks.at[k + 1] <= low * (1 + nearly);
    return !is_below && !(k > 0 && ticks.at[k - 1] >= high * (1 - nearly));
  };
  std::vector<double> needed;
  for (std::size_t k = 0; k < ticks.at.size(); ++k)
    if (is_needed(k)) needed.push_back(ticks.at[k]);
  if (needed.size() > 1) ticks.at = std::move(needed);
  ticks.low = ticks.at.front(), ticks.high = ticks.at.back();
  return ticks;
}

}  // namespace vibrosow
