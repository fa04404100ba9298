#include "calibration/bench_plan.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibration/calibration.hpp"
#include "scene/input_error.hpp"
#include "study/evaluate.hpp"
#include "surrogate/gaussian_process.hpp"
#include "surrogate/sobol_points.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index points_averaged = 64;
constexpr double difference = 0.05;                   // of the ranges, for slopes
constexpr double prior_information = 12;              // of a flat prior in 0..1
constexpr double factor_deviation = 1.1;              // of the logarithm of an unknown factor: three times less or more
constexpr double seeds_wanted = 1000;                 // in a reading
constexpr double share_of_fill = 0.5;                 // that a reading may take
constexpr double least_catch = 10, most_catch = 120;  // s
constexpr int usual_repeats = 3, least_repeats = 2;

/// To three digits, as a person sets it.
double settable(double value) {
  const double unit = std::pow(10.0, 2 - std::floor(std::log10(std::abs(value))));
  return value == 0 ? 0 : std::round(value * unit) / unit;
}

double depth_of(const Evaluation& evaluation) {
  return evaluation.outflow.depth_factor.value_or(1);
}

/// Seeds of the fills that are not kept up; 0 where one is.
double seeds_to_give(const Scene& scene) {
  double count = 0;
  for (const Vessel* vessel : {&scene.tray, scene.hopper ? &*scene.hopper : nullptr}) {
    if (vessel == nullptr || !vessel->fill) continue;
    if (is_kept(*vessel)) return 0;
    count += vessel->fill->count;
  }
  return count;
}

/// What the runs say, of all conditions together.
struct Flows {
  MatrixXd places;               // parts of the keys' ranges, then of the settings'; one run a row
  VectorXd log_rates;            // kg/s
  std::vector<int> tried, gave;  // of each condition: runs, and those that let something through
  double seeds_per_kg = 0;       // of the tray as far as its depth is known, over what the scene gives; mean
  double scene_seeds_per_kg = 0;
  double to_give = 0;  // seeds of a fill that is not kept up; 0: for ever
  double window = 0;   // s
  std::vector<CountedDoubt> doubts;

  /// Whether enough flows under a condition to tell.
  bool is_told(std::size_t condition) const { return 2 * gave[condition] >= tried[condition]; }
};

/// Of each condition, where each of its settings lies between the least and the most that is tried.
MatrixXd settings_of(const std::vector<std::vector<Condition>>& conditions) {
  MatrixXd parts(static_cast<Index>(conditions.size()), static_cast<Index>(conditions.front().size()));
  for (Index c = 0; c < parts.rows(); ++c)
    for (Index k = 0; k < parts.cols(); ++k)
      parts(c, k) = conditions[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)].number.value();
  const Eigen::RowVectorXd least = parts.colwise().minCoeff(), most = parts.colwise().maxCoeff();
  return (parts.rowwise() - least).array().rowwise() / (most - least).array();
}

/// Points of the keys under one condition, as the surrogate takes them.
MatrixXd under(const MatrixXd& points, const Eigen::RowVectorXd& settings) {
  MatrixXd places(points.rows(), points.cols() + settings.cols());
  places << points, settings.replicate(points.rows(), 1);
  return places;
}

/// None where a run is missing.
std::optional<Flows> flows_of(const CalibrationDesign& design, const MatrixXd& settings, const KeptRuns& kept) {
  Flows flows;
  flows.tried.assign(design.conditions.size(), 0);
  flows.gave = flows.tried;
  std::vector<const CalibrationRun*> flowing;
  std::vector<double> rates;
  std::vector<std::vector<Doubt>> doubts;
  for (const CalibrationRun& run : design.runs) {
    const std::optional<Run> made = kept(name_of_run(run.scene, run.random_seed));
    if (!made) return std::nullopt;
    ++flows.tried[run.condition];
    const Evaluation evaluation = reduced(run.scene, *made);
    const HoleOutflow* all = find_row(evaluation.outflow, "all", "all");
    if (!evaluation.is_sound() || all == nullptr || !(all->mass_rate > 0)) continue;
    ++flows.gave[run.condition];
    flowing.push_back(&run);
    rates.push_back(std::log(all->mass_rate));
    doubts.push_back(evaluation.outflow.doubts);
    flows.scene_seeds_per_kg += all->seeds_per_s / all->mass_rate;
    flows.seeds_per_kg += all->seeds_per_s / all->mass_rate * depth_of(evaluation);
    flows.to_give += seeds_to_give(run.scene);
    flows.window += evaluation.outflow.window.length();
  }
  std::vector<const std::vector<Doubt>*> of_runs;
  for (const std::vector<Doubt>& of_run : doubts) of_runs.push_back(&of_run);
  flows.doubts = counted_doubts(of_runs);
  const auto count = static_cast<Index>(flowing.size());
  for (double* sum : {&flows.scene_seeds_per_kg, &flows.seeds_per_kg, &flows.to_give, &flows.window})
    *sum /= static_cast<double>(std::max<Index>(count, 1));
  flows.log_rates = Eigen::Map<const VectorXd>(rates.data(), count);
  flows.places.resize(count, design.points.cols() + settings.cols());
  for (Index i = 0; i < count; ++i) {
    const CalibrationRun& run = *flowing[static_cast<std::size_t>(i)];
    flows.places.row(i) = under(design.points.row(run.point), settings.row(static_cast<Index>(run.condition)));
  }
  return flows;
}

/// Slopes of the surrogate along the keys at each point under a condition, one a row; a last column of ones for an
/// unknown factor.
MatrixXd slopes_of(const GaussianProcess& surrogate, const MatrixXd& points, const Eigen::RowVectorXd& settings,
                   bool with_factor) {
  MatrixXd result = MatrixXd::Ones(points.rows(), points.cols() + (with_factor ? 1 : 0));
  for (Index d = 0; d < points.cols(); ++d) {
    MatrixXd up = points, down = points;
    up.col(d) = (up.col(d).array() + difference).min(1.0);
    down.col(d) = (down.col(d).array() - difference).max(0.0);
    result.col(d) = (surrogate.at(under(up, settings)).mean - surrogate.at(under(down, settings)).mean).array() /
                    (up.col(d) - down.col(d)).array();
  }
  return result;
}

/// Information of the keys at each of the points averaged over, as conditions are added.
class Information {
 public:
  Information(Index keys, bool with_factor) {
    VectorXd prior = VectorXd::Constant(keys + (with_factor ? 1 : 0), prior_information);
    if (with_factor) prior(keys) = 1 / (factor_deviation * factor_deviation);
    at_points_.assign(static_cast<std::size_t>(points_averaged), prior.asDiagonal());
  }

  void add(const MatrixXd& rows, double weight) {
    for (std::size_t i = 0; i < at_points_.size(); ++i) {
      const VectorXd row = rows.row(static_cast<Index>(i)).transpose();
      at_points_[i] += weight * row * row.transpose();
    }
  }

  double log_determinant() const {
    double sum = 0;
    for (const MatrixXd& one : at_points_)
      sum += 2 * Eigen::LLT<MatrixXd>(one).matrixLLT().diagonal().array().log().sum();
    return sum / static_cast<double>(at_points_.size());
  }

  /// 1 less the root mean square of a key's deviation over that of its prior.
  double contraction(Index key) const {
    double variance = 0;
    for (const MatrixXd& one : at_points_) variance += one.inverse()(key, key);
    return 1 - std::sqrt(variance / static_cast<double>(at_points_.size()) * prior_information);
  }

 private:
  std::vector<MatrixXd> at_points_;
};

/// The same for all readings: long enough for the slowest candidate that tells, short enough for the one that empties
/// first.
double catch_time(const Flows& flows, const std::vector<BenchCandidate>& candidates) {
  double time = least_catch, most = most_catch;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!flows.is_told(c)) continue;
    time = std::max(time, seeds_wanted / (flows.seeds_per_kg * candidates[c].mass_rate));
    if (flows.to_give > 0)
      most = std::min(most, share_of_fill * flows.to_give / (flows.scene_seeds_per_kg * candidates[c].mass_rate));
  }
  time = std::min(time, most);
  return time >= 5 ? 5 * std::floor(time / 5) : std::max(1.0, std::floor(time));
}

/// Of one candidate at the points averaged over; none where too little flows to tell.
using Slopes = std::optional<MatrixXd>;

/// Of what calibrate will know of a condition's rate from its usual number of runs, each off by `noise` (variance of
/// the logarithm): of a trend along the keys, mean over the runs.
double variance_of_fit(double noise, std::size_t keys, int conditions) {
  const double runs = static_cast<double>(CalibrationTask().most_runs) / conditions;
  return noise * static_cast<double>(keys + 1) / runs;
}

/// The candidate, of those without a place, that adds most to the information.
std::size_t most_telling(const BenchPlan& plan, const std::vector<Slopes>& slopes, const Information& information,
                         double weight) {
  std::optional<std::size_t> best;
  double most = 0;
  for (std::size_t c = 0; c < slopes.size(); ++c) {
    if (!slopes[c] || plan.candidates[c].place) continue;
    Information with = information;
    with.add(*slopes[c], weight);
    const double determinant = with.log_determinant();
    if (best && determinant <= most) continue;
    best = c, most = determinant;
  }
  return best.value();
}

}  // namespace

int BenchPlan::readings() const {
  return repeats * static_cast<int>(chosen().size());
}

std::vector<const BenchCandidate*> BenchPlan::chosen() const {
  std::vector<const BenchCandidate*> result;
  for (const BenchCandidate& candidate : candidates)
    if (candidate.place) result.push_back(&candidate);
  std::ranges::sort(result, {}, [](const BenchCandidate* candidate) { return *candidate->place; });
  return result;
}

MeasuredTable bench_candidates(const std::vector<KeyRange>& settings) {
  MeasuredTable table;
  const int levels = settings.size() <= 2 ? 3 : 2;
  std::vector<std::vector<Condition>> grid{{}};
  for (const KeyRange& setting : settings) {
    if (settable(setting.low) == settable(setting.high))
      throw InputError(fmt::format("--try {}: its ends are the same to three digits", setting.key));
    table.condition_keys.push_back(setting.key);
    std::vector<std::vector<Condition>> longer;
    for (const std::vector<Condition>& point : grid)
      for (int level = 0; level < levels; ++level) {
        const double value = settable(setting.at(static_cast<double>(level) / (levels - 1)));
        longer.push_back(point);
        longer.back().push_back({setting.key, fmt::format("{}", value), value});
      }
    grid = std::move(longer);
  }
  for (std::vector<Condition>& conditions : grid) {
    MeasuredSeries series;
    series.conditions = std::move(conditions);
    series.where = "a setting to be tried";
    table.series.push_back(std::move(series));
  }
  return table;
}

std::optional<BenchPlan> plan_bench(const CalibrationTask& task, const CalibrationDesign& design,
                                    const BenchLimits& limits, const KeptRuns& kept) {
  const auto keys = static_cast<Index>(task.keys.size());
  const MatrixXd settings = settings_of(design.conditions);
  const std::optional<Flows> flows = flows_of(design, settings, kept);
  if (!flows) return std::nullopt;
  const auto flowing = flows->log_rates.size();
  if (flowing < flows->places.cols() + 4)
    throw InputError(fmt::format("{}: {} under the settings that are tried: {} of {} runs let something through",
                                 task.seeder.string(), flowing == 0 ? "nothing flows" : "too little flows", flowing,
                                 design.runs.size()));
  const GaussianProcess surrogate(flows->places, flows->log_rates);
  BenchPlan plan;
  plan.whole_rates = task.measured.scale != MeasuredScale::free;
  plan.doubts = shared_doubts({{0, flows->doubts}});
  const MatrixXd points = sobol_points(points_averaged, keys);
  std::vector<Slopes> slopes;
  for (std::size_t c = 0; c < design.conditions.size(); ++c) {
    const Eigen::RowVectorXd set = settings.row(static_cast<Index>(c));
    plan.candidates.push_back({.conditions = design.conditions[c]});
    plan.candidates.back().mass_rate = std::exp(surrogate.at(under(points, set)).mean.mean());
    slopes.push_back(flows->is_told(c) ? Slopes(slopes_of(surrogate, points, set, !plan.whole_rates)) : std::nullopt);
  }
  plan.catch_time = catch_time(*flows, plan.candidates);
  const double chance = std::sqrt(surrogate.noise() * flows->window / plan.catch_time + limits.noise * limits.noise);
  for (BenchCandidate& candidate : plan.candidates) candidate.chance = chance;
  const auto usable = static_cast<int>(std::ranges::count_if(slopes, &Slopes::has_value));
  const int readings = static_cast<int>(limits.time / (plan.catch_time + limits.handling));
  plan.repeats = readings / usual_repeats > static_cast<int>(keys) ? usual_repeats : least_repeats;
  const int wanted = std::min(readings / plan.repeats, usable);
  if (wanted < 1)
    throw InputError(fmt::format("--time: {:g} min are too short for {} readings of {:g} s", limits.time / 60,
                                 least_repeats, plan.catch_time));
  const int held_out = usual_hold_out(task.measured.table).every;
  Information information(keys, !plan.whole_rates), fitted = information;
  const double weight =
      1 / (chance * chance / plan.repeats + variance_of_fit(surrogate.noise(), task.keys.size(), wanted));
  for (int place = 1; place <= wanted; ++place) {
    const std::size_t best = most_telling(plan, slopes, information, weight);
    plan.candidates[best].place = place;
    information.add(*slopes[best], weight);
    if (place % held_out != 0) fitted.add(*slopes[best], weight);
  }
  for (Index k = 0; k < keys; ++k) plan.contraction.push_back(fitted.contraction(k));
  return plan;
}

}  // namespace vibrosow
