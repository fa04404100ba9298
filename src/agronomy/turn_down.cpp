#include "agronomy/turn_down.hpp"

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

bool will_do(const Setting& setting, double cv_limit, Proof proof) {
  const bool even =
      proof == Proof::shown ? setting.cv_high && *setting.cv_high <= cv_limit : setting.cv_low <= cv_limit;
  return setting.flowed && setting.rate > 0 && even;
}

}  // namespace

std::optional<TurnDown> turn_down(std::vector<Setting> settings, double cv_limit, Proof proof) {
  std::ranges::sort(settings, {}, &Setting::value);
  std::optional<TurnDown> best, here;
  for (const Setting& setting : settings) {
    if (!will_do(setting, cv_limit, proof)) {
      here.reset();
      continue;
    }
    if (!here) here = TurnDown{1, setting.value, setting.value, setting.rate, setting.rate, 0};
    here->to = setting.value;
    here->least_rate = std::min(here->least_rate, setting.rate);
    here->most_rate = std::max(here->most_rate, setting.rate);
    here->ratio = here->most_rate / here->least_rate;
    ++here->settings;
    if (!best || here->ratio >= best->ratio) best = here;
  }
  return best;
}

std::optional<SlopeSensitivity> slope_sensitivity(const std::vector<TiltedRate>& rates) {
  double mean_tilt = 0, mean_rate = 0, squares = 0;
  for (const TiltedRate& one : rates) {
    mean_tilt += one.tilt / static_cast<double>(rates.size());
    mean_rate += one.rate / static_cast<double>(rates.size());
  }
  for (const TiltedRate& one : rates) squares += (one.tilt - mean_tilt) * (one.tilt - mean_tilt);
  if (!(squares > 0)) return std::nullopt;
  double slope = 0, spread = 0;
  bool known = true;
  for (const TiltedRate& one : rates) {
    const double weight = (one.tilt - mean_tilt) / squares;
    slope += weight * one.rate;
    known = known && one.half_width;
    spread += std::pow(weight * one.half_width.value_or(0), 2);
  }
  const double level = mean_rate - slope * mean_tilt;
  if (!(level > 0)) return std::nullopt;
  SlopeSensitivity result{slope / level, std::nullopt, std::nullopt};
  if (known) result.half_width = std::sqrt(spread) / level;
  if (rates.size() < 3) return result;
  result.off_line = 0;
  for (const TiltedRate& one : rates)
    result.off_line = std::max(*result.off_line, std::abs(one.rate - level - slope * one.tilt) / level);
  return result;
}

}  // namespace vibrosow
