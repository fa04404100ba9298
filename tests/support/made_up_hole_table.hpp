#pragma once

#include <cmath>
#include <vector>

#include "agronomy/hole_table.hpp"

namespace vibrosow {

/// Outflow of a table that follows a law: (width - 1)^(5/2), over the speed with its most at 1.4, half of it in a bed
/// of 3 rather than 6 seeds, and longer seeds slower.
inline double made_up_outflow(const HoleConditions& at) {
  const double speed = std::exp(-0.5 * std::pow(std::log(at.peak_speed / 1.4), 2));
  return 0.4 * std::pow(at.width - 1, 2.5) * speed * (at.depth / 6) / at.aspect;
}

inline HoleRecord made_up_record(const HoleConditions& at) {
  HoleRecord record;
  record.at = at;
  record.amplitude = 2;
  record.runs = 3;
  record.seeds = 300;
  record.outflow = made_up_outflow(at);
  record.half_width_95 = 0.05 * record.outflow;
  record.dispersion = at.width < 2.5 ? 1.2 : 0.4;
  record.longest_pause = at.width < 2.5 ? 14 : 3;
  record.stood_still = at.width < 2.5 ? 0.25 : 0;
  record.watched = 400;
  return record;
}

/// Balls on a fine grid and seeds twice as long as wide on a coarser one.
inline std::vector<HoleRecord> made_up_records() {
  std::vector<HoleRecord> records;
  for (const double depth : {3.0, 6.0}) {
    for (const double width : {2.0, 2.5, 3.0, 4.0, 5.0, 6.5})
      for (const double speed : {0.7, 1.4, 2.4, 3.8}) records.push_back(made_up_record({1, width, speed, depth}));
    for (const double width : {2.5, 3.5, 5.0})
      for (const double speed : {0.7, 1.4, 3.0}) records.push_back(made_up_record({2, width, speed, depth}));
  }
  return records;
}

}  // namespace vibrosow
