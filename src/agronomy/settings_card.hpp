#pragma once

#include <optional>
#include <vector>

#include "agronomy/tray_rates.hpp"

namespace vibrosow {

/// Speeds (m/s) that a settings card is of: 4 to 14 km/h, by 1.
std::vector<double> card_speeds();

/// What to set at one speed of the drill.
struct CardRow {
  double speed = 0;                           // m/s
  double needed = 0;                          // kg/s, of all holes
  std::optional<CorrectedSetting> setting{};  // none: the table has none
  bool is_other_width = false;                // no frequency gives it, but another width of the holes does
  bool clogs = false;                         // its holes are so narrow for the largest seeds (HoleClass)
};

/// At each speed the frequency that gives what `rows` rows of a task need; all on one side of where the outflow is
/// most, that of `more_by_faster`, else that which serves more speeds, so that the driver turns it one way. Where none
/// does, another width of the holes.
std::vector<CardRow> settings_card(const TrayRates& rates, const SowingTask& task, int rows,
                                   const std::optional<bool>& more_by_faster = std::nullopt);

}  // namespace vibrosow
