#pragma once

#include <optional>
#include <vector>

#include "outflow/statistics.hpp"

namespace vibrosow {

/// How often a study runs each layout.
struct Replicates {
  int number = 5;                  // where `interval` is none
  std::optional<double> interval;  // wanted half width of the 95 % interval of the mass rate, over its mean
  int most = 40;                   // at which it is given up

  static constexpr int least_by_interval = 10;
  /// How many runs a layout begins with.
  int first() const { return interval ? least_by_interval : number; }
};

/// The first number of runs, at least ten that flowed, whose interval is as narrow as wanted; none where these runs do
/// not reach it. `rates`: of each run, by random seed, none of those that clogged, which are not counted. So it depends
/// on no run after that number, and not on who made how many. Throws std::logic_error without a wanted interval.
std::optional<int> enough_runs(const std::vector<std::optional<CountedRate>>& rates, const Replicates& wanted);

/// To how many runs a layout should go on, by the scatter so far, at most to twice as many; `rates.size()` where that
/// is enough or the most.
int runs_to_go_to(const std::vector<std::optional<CountedRate>>& rates, const Replicates& wanted);

/// Whether values scatter so unevenly to both sides that a normal law is not likely (their skewness is beyond twice its
/// standard error, Joanes & Gill 1998): the interval of their mean then holds less often than 95 times in 100. False
/// for fewer than ten.
bool look_skewed(const std::vector<double>& values);

}  // namespace vibrosow
