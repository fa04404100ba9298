#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/calibration_design.hpp"

namespace vibrosow {

/// What a bench sheet is asked for.
struct BenchAsked {
  std::filesystem::path seeder;
  std::vector<Override> overrides;
  std::vector<KeyRange> keys, settings;  // none: the usual ones
  int most_runs = 60;
  std::uint64_t random_seed = 1;
};

/// The runs that a sheet is made from.
struct BenchRuns {
  CalibrationTask task;  // its table is of bench_candidates
  CalibrationDesign design;
  double seconds = 0;                   // CPU time of all, as `usual_seconds` has it
  bool is_draft = false;                // the level was taken that the seeder has not
  std::vector<std::string> left_out{};  // settings that are not tried, by their keys
};

/// CPU time (s) that a sheet may take in all: ten minutes of two cores.
inline constexpr double bench_budget = 1200;

/// The best runs that `budget` (s) buys by `usual_seconds`, the same on every machine: all settings as the seeder is
/// written; where so many runs cost more, the level "draft" unless the seeder or --fit says how stiff seeds are, with
/// fewer runs at need; then the first setting alone. Throws InputError where that costs more still, for a tray without
/// harmonic motion when no settings are asked for, and as `design_bench` does.
BenchRuns affordable_bench(const BenchAsked& asked, const std::shared_ptr<SourceFiles>& files,
                           double budget = bench_budget);

}  // namespace vibrosow
