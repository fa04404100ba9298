#include "agronomy/settings_card.hpp"

#include <algorithm>

namespace vibrosow {
namespace {

constexpr int slowest = 4, fastest = 14;  // km/h

std::optional<CorrectedSetting> on_side(const std::vector<CorrectedSetting>& settings, bool more_by_faster) {
  const auto found = std::ranges::find(settings, more_by_faster, &CorrectedSetting::more_by_faster);
  return found == settings.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::vector<double> card_speeds() {
  std::vector<double> speeds;
  for (int speed = slowest; speed <= fastest; ++speed) speeds.push_back(speed * kilometre_per_hour);
  return speeds;
}

std::vector<CardRow> settings_card(const TrayRates& rates, const SowingTask& task, int rows,
                                   const std::optional<bool>& more_by_faster) {
  std::vector<CardRow> card;
  std::vector<std::vector<CorrectedSetting>> settings;
  for (const double speed : card_speeds()) {
    const double needed = rows * row_rate(task.sowing_rate, {task.pace.row_spacing, speed});
    card.push_back({.speed = speed, .needed = needed});
    settings.push_back(rates.by_frequency(needed));
  }
  const auto served = [&](bool side) {
    return std::ranges::count_if(settings, [&](const auto& one) { return on_side(one, side).has_value(); });
  };
  const bool side = more_by_faster.value_or(served(true) >= served(false));
  for (std::size_t i = 0; i < card.size(); ++i) {
    CardRow& row = card[i];
    row.setting = on_side(settings[i], side);
    if (!row.setting) {
      row.setting = rates.by_width(row.needed);
      row.is_other_width = row.setting.has_value();
    }
    row.clogs = row.setting && hole_class(row.setting->width / task.seed.largest_diameter()) == HoleClass::clogs;
  }
  return card;
}

}  // namespace vibrosow
