#include "calibration/calibration_design.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "study/comparison.hpp"
#include "study/latin_hypercube.hpp"

namespace vibrosow {
namespace {

constexpr double repeated_share = 0.2;  // of the points, run a second time
constexpr Eigen::Index least_repeated = 2;

/// How many different points, and how many of them again.
struct Counts {
  Eigen::Index different, repeated;
};

/// Of what can be afforded.
Counts shared_out(Eigen::Index affordable) {
  const auto repeated = std::max(least_repeated, static_cast<Eigen::Index>(repeated_share / (1 + repeated_share) *
                                                                           static_cast<double>(affordable)));
  return {affordable - repeated, repeated};
}

/// Points for a trend along so many axes and what departs from it.
Eigen::Index points_needed(std::size_t axes) {
  return 3 * (static_cast<Eigen::Index>(axes) + 1);
}

/// With those that are made again.
std::size_t with_repeats(Eigen::Index needed) {
  return static_cast<std::size_t>(needed + std::max(least_repeated, needed / 5 + 1));
}

Counts counts_for(const CalibrationTask& task, std::size_t conditions) {
  const Counts counts = shared_out(static_cast<Eigen::Index>(static_cast<std::size_t>(task.most_runs) / conditions));
  const Eigen::Index needed = points_needed(task.keys.size());
  if (counts.different < needed)
    throw InputError(fmt::format(
        "--runs {}: {} keys under {} conditions need at least {} runs; fit fewer keys (--fit), or leave conditions out",
        task.most_runs, task.keys.size(), conditions, with_repeats(needed) * conditions));
  return counts;
}

/// Points of a Latin hypercube over the keys' ranges, the first of them a second time at the end.
Eigen::MatrixXd drawn_points(const CalibrationTask& task, const Counts& counts) {
  const auto dimensions = static_cast<Eigen::Index>(task.keys.size());
  Eigen::MatrixXd points(counts.different + counts.repeated, dimensions);
  const auto cube = latin_hypercube(static_cast<std::size_t>(counts.different), task.keys.size(), task.random_seed);
  for (Eigen::Index point = 0; point < counts.different; ++point)
    points.row(point) = Eigen::Map<const Eigen::RowVectorXd>(cube[static_cast<std::size_t>(point)].data(), dimensions);
  points.bottomRows(counts.repeated) = points.topRows(counts.repeated);
  return points;
}

std::vector<std::vector<Condition>> conditions_of(const MeasuredTable& table) {
  std::vector<std::vector<Condition>> conditions;
  for (const MeasuredSeries& series : table.series)
    if (std::ranges::find(conditions, series.conditions) == conditions.end()) conditions.push_back(series.conditions);
  return conditions;
}

void check_keys(const CalibrationTask& task) {
  if (task.keys.empty()) throw InputError("--fit: nothing is left to be fitted");
  for (const KeyRange& fitted : task.keys) {
    if (std::ranges::count(task.keys, fitted.key, &KeyRange::key) > 1)
      throw InputError(fmt::format("--fit {}: is fitted twice", fitted.key));
    if (std::ranges::count(task.overrides, fitted.key, &Override::key) > 0)
      throw InputError(fmt::format("--fit {}: is set by --set as well", fitted.key));
    if (std::ranges::count(task.measured.table.condition_keys, fitted.key) > 0)
      throw InputError(fmt::format("--fit {}: is a condition of {} as well", fitted.key, task.measured.file.string()));
  }
}

/// That a scene can be measured as the series was.
void check_scene_measurable(const CalibrationTask& task, const MeasuredSeries& series, const Scene& scene) {
  check_measurable(task.measured, series, scene, task.seeder.string());
  if (task.measured.scale == MeasuredScale::depth && !scene.tray.depth)
    throw InputError(fmt::format("{}: --scale depth needs tray.depth", task.seeder.string()));
}

}  // namespace

Scene calibration_scene(const CalibrationTask& task, const std::vector<Condition>& conditions,
                        const Eigen::VectorXd& point, const std::shared_ptr<SourceFiles>& files) {
  std::vector<Override> overrides = task.overrides;
  for (const Condition& condition : conditions)
    overrides.push_back(override_of(condition, task.measured.file.string()));
  for (std::size_t k = 0; k < task.keys.size(); ++k)
    overrides.push_back(task.keys[k].override_at(point(static_cast<Eigen::Index>(k))));
  return read_scene(task.seeder, overrides, files);
}

Scene middle_scene(const CalibrationTask& task, const std::shared_ptr<SourceFiles>& files) {
  return calibration_scene(task, {}, Eigen::VectorXd::Constant(static_cast<Eigen::Index>(task.keys.size()), 0.5),
                           files);
}

CalibrationDesign design_calibration(const CalibrationTask& task, const std::shared_ptr<SourceFiles>& files) {
  check_keys(task);
  if (is_curve(task.measured.table.quantity) && task.measured.scale == MeasuredScale::free)
    throw InputError(
        fmt::format("{}: --scale free goes with rates; of curves expected none or depth", task.measured.file.string()));
  if (task.measured.table.quantity == MeasuredQuantity::fraction_curve && task.measured.scale != MeasuredScale::none)
    throw InputError(fmt::format("{}: discharged_percent needs no scale; only --scale none is allowed",
                                 task.measured.file.string()));
  CalibrationDesign design;
  design.conditions = conditions_of(task.measured.table);
  design.points = drawn_points(task, counts_for(task, design.conditions.size()));
  std::uint64_t seed = task.random_seed;
  for (Eigen::Index point = 0; point < design.points.rows(); ++point)
    for (std::size_t condition = 0; condition < design.conditions.size(); ++condition)
      design.runs.push_back(
          {point, condition, seed++,
           calibration_scene(task, design.conditions[condition], design.points.row(point).transpose(), files)});
  for (const MeasuredSeries& series : task.measured.table.series) {
    const auto condition = std::ranges::find(design.conditions, series.conditions) - design.conditions.begin();
    check_scene_measurable(task, series, design.runs[static_cast<std::size_t>(condition)].scene);
  }
  return design;
}

int fewest_bench_runs(std::size_t keys_and_settings) {
  return static_cast<int>(with_repeats(points_needed(keys_and_settings)));
}

CalibrationDesign design_bench(const CalibrationTask& task, const std::shared_ptr<SourceFiles>& files) {
  check_keys(task);
  const std::size_t settings = task.measured.table.condition_keys.size();
  if (const int fewest = fewest_bench_runs(task.keys.size() + settings); task.most_runs < fewest)
    throw InputError(
        fmt::format("--runs {}: {} keys and {} settings need at least {} runs; fit fewer keys (--fit), or try fewer "
                    "settings (--try)",
                    task.most_runs, task.keys.size(), settings, fewest));
  CalibrationDesign design;
  design.conditions = conditions_of(task.measured.table);
  const Counts counts = shared_out(task.most_runs);
  design.points = drawn_points(task, counts);
  for (Eigen::Index point = 0; point < design.points.rows(); ++point) {
    const std::size_t condition = static_cast<std::size_t>(point % counts.different) % design.conditions.size();
    design.runs.push_back(
        {point, condition, task.random_seed + static_cast<std::uint64_t>(point),
         calibration_scene(task, design.conditions[condition], design.points.row(point).transpose(), files)});
  }
  return design;
}

std::vector<WantedRun> wanted_runs(const CalibrationDesign& design) {
  std::vector<WantedRun> wanted;
  for (const CalibrationRun& run : design.runs)
    wanted.push_back(
        {&run.scene, run.random_seed, name_of_run(run.scene, run.random_seed), 1, static_cast<int>(run.condition) + 1});
  return wanted;
}

}  // namespace vibrosow
