#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agronomy/turn_down.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// Layouts of a study that differ in one key alone, and what they tell of a drive or a slope.
struct TradeLine {
  std::string key;
  std::vector<std::size_t> layouts;                 // indices in Study::layouts, in the order of the study
  std::optional<TurnDown> shown{}, not_excluded{};  // where the key drives the tray
  std::size_t unsound = 0;  // layouts that tell nothing: runs are missing, stopped or doubtful; of a slope also clogged
  bool is_slope = false;    // it is the tilt
  std::optional<SlopeSensitivity> slope{};  // of a slope, where two sound rates tell it
};

/// One for each such set of at least two layouts of a seeder with a drill: along the frequency and the amplitude of the
/// tray's motion its turn-down, to which a layout that is not `ok` is a setting that will not do; along the tray's tilt
/// its sensitivity to slope, of the layouts whose runs all flowed without a serious doubt. Key by key, in the order of
/// the study.
std::vector<TradeLine> trade_lines(const StudyResult& result);

}  // namespace vibrosow
