#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/key_range.hpp"
#include "study/study.hpp"
#include "study/study_runs.hpp"

namespace vibrosow {

/// What is to be fitted to what.
struct CalibrationTask {
  std::filesystem::path seeder;
  std::vector<Override> overrides;
  std::vector<KeyRange> keys;
  MeasuredPart measured;  // its matches are left empty
  int most_runs = 150;
  std::uint64_t random_seed = 1;
};

/// One run: a point of the fitted keys under one condition.
struct CalibrationRun {
  Eigen::Index point;     // row of CalibrationDesign::points
  std::size_t condition;  // index in CalibrationDesign::conditions
  std::uint64_t random_seed;
  Scene scene;
};

/// Which runs are made: every point of a Latin hypercube under every measured condition, and some points again under
/// other random seeds, which tell chance apart. The order is that of the random seeds.
struct CalibrationDesign {
  std::vector<std::vector<Condition>> conditions;  // under which the table was measured, each once
  Eigen::MatrixXd points;                          // parts of the keys' ranges, one point a row
  std::vector<CalibrationRun> runs;
};

/// Throws InputError for wrong input of any kind: no key, one that is fitted twice or set or a condition as well, a
/// hole or lot that the seeder has not, a curve of a fraction without a fill, a depth that is not there, runs too few
/// for so many keys and conditions, or a range that leaves what the key may be.
CalibrationDesign design_calibration(const CalibrationTask& task, const std::shared_ptr<SourceFiles>& files);

/// The runs from which a bench's settings are chosen: each point of a Latin hypercube under one condition of the table
/// alone, the conditions in turn, and some points again under other random seeds. `most_runs` of them in all, at least
/// `fewest_bench_runs`. Throws InputError as `design_calibration` does.
CalibrationDesign design_bench(const CalibrationTask& task, const std::shared_ptr<SourceFiles>& files);

/// So few runs tell of a rate over so many fitted keys and settings together.
int fewest_bench_runs(std::size_t keys_and_settings);

/// The seeder at one point of the keys (parts of their ranges) under conditions.
Scene calibration_scene(const CalibrationTask& task, const std::vector<Condition>& conditions,
                        const Eigen::VectorXd& point, const std::shared_ptr<SourceFiles>& files);

/// The seeder as it is, with the keys in the middle of their ranges.
Scene middle_scene(const CalibrationTask& task, const std::shared_ptr<SourceFiles>& files);

/// The runs of a design, which must outlive them.
std::vector<WantedRun> wanted_runs(const CalibrationDesign& design);

}  // namespace vibrosow
