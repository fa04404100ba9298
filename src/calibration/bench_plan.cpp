#include "calibration/bench_plan.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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

/// What the runs of one candidate say.
struct Flow {
  MatrixXd points;
  VectorXd log_rates;      // kg/s
  double seeds_per_s = 0;  // of the tray as far as its depth is known, mean
  double emptied_in = 0;   // s, of a fill that is not kept up; 0: never
  double window = 0;       // s
};

double depth_of(const Evaluation& evaluation) {
  return evaluation.outflow.depth_factor.value_or(1);
}

/// Time in which the fills that are not kept up leave at this rate; 0: never.
double emptying_time(const Scene& scene, double slice_seeds_per_s) {
  double count = 0;
  for (const Vessel* vessel : {&scene.tray, scene.hopper ? &*scene.hopper : nullptr}) {
    if (vessel == nullptr || !vessel->fill) continue;
    if (vessel->fill->keep) return 0;
    count += vessel->fill->count;
  }
  return slice_seeds_per_s > 0 ? count / slice_seeds_per_s : 0;
}

/// None where a run is missing.
std::optional<Flow> flow_of(const CalibrationDesign& design, std::size_t condition, const KeptRuns& kept) {
  std::vector<Index> points;
  std::vector<double> rates;
  Flow flow;
  double seeds = 0, emptied = 0;
  for (const CalibrationRun& run : design.runs) {
    if (run.condition != condition) continue;
    const std::optional<Run> made = kept(name_of_run(run.scene, run.random_seed));
    if (!made) return std::nullopt;
    const Evaluation evaluation = reduced(run.scene, *made);
    const HoleOutflow* all = find_row(evaluation.outflow, "all", "all");
    if (!evaluation.is_sound() || all == nullptr || !(all->mass_rate > 0)) continue;
    points.push_back(run.point);
    rates.push_back(all->mass_rate);
    seeds += all->seeds_per_s * depth_of(evaluation);
    emptied += emptying_time(run.scene, all->seeds_per_s);
    flow.window = evaluation.outflow.window.length();
  }
  const auto count = static_cast<Index>(points.size());
  flow.points.resize(count, design.points.cols());
  flow.log_rates.resize(count);
  for (Index i = 0; i < count; ++i) {
    flow.points.row(i) = design.points.row(points[static_cast<std::size_t>(i)]);
    flow.log_rates(i) = std::log(rates[static_cast<std::size_t>(i)]);
  }
  flow.seeds_per_s = seeds / static_cast<double>(std::max<Index>(count, 1));
  flow.emptied_in = emptied / static_cast<double>(std::max<Index>(count, 1));
  return flow;
}

/// Slopes of the surrogate along the keys at each point, one a row; a last column of ones for an unknown factor.
MatrixXd slopes_of(const GaussianProcess& surrogate, const MatrixXd& points, bool with_factor) {
  MatrixXd result = MatrixXd::Ones(points.rows(), points.cols() + (with_factor ? 1 : 0));
  for (Index d = 0; d < points.cols(); ++d) {
    MatrixXd up = points, down = points;
    up.col(d) = (up.col(d).array() + difference).min(1.0);
    down.col(d) = (down.col(d).array() - difference).max(0.0);
    result.col(d) = (surrogate.at(up).mean - surrogate.at(down).mean).array() / (up.col(d) - down.col(d)).array();
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

/// The same for all readings: long enough for the slowest candidate, short enough for the one that empties first.
double catch_time(const std::vector<Flow>& flows) {
  double time = least_catch, most = most_catch;
  for (const Flow& flow : flows) {
    if (flow.seeds_per_s > 0) time = std::max(time, seeds_wanted / flow.seeds_per_s);
    if (flow.emptied_in > 0) most = std::min(most, share_of_fill * flow.emptied_in);
  }
  time = std::min(time, most);
  return time >= 5 ? 5 * std::floor(time / 5) : std::max(1.0, std::floor(time));
}

/// Of one candidate at the points averaged over; none where too little flows to tell.
using Slopes = std::optional<MatrixXd>;

/// Fills in what the runs of a candidate say.
Slopes look_at(BenchCandidate& candidate, const Flow& flow, const MatrixXd& points, const BenchPlan& plan,
               double noise) {
  if (flow.log_rates.size() < points.cols() + 4) return std::nullopt;
  const GaussianProcess surrogate(flow.points, flow.log_rates);
  const double flow_chance = surrogate.noise() * flow.window / plan.catch_time;
  candidate.mass_rate = std::exp(surrogate.at(points).mean.mean());
  candidate.chance = std::sqrt(flow_chance + noise * noise);
  return slopes_of(surrogate, points, !plan.whole_rates);
}

/// Of all readings of a candidate.
double weight_of(const BenchPlan& plan, std::size_t candidate) {
  const double chance = plan.candidates[candidate].chance;
  return plan.repeats / (chance * chance);
}

/// The candidate, of those without a place, that adds most to the information.
std::size_t most_telling(const BenchPlan& plan, const std::vector<Slopes>& slopes, const Information& information) {
  std::optional<std::size_t> best;
  double most = 0;
  for (std::size_t c = 0; c < slopes.size(); ++c) {
    if (!slopes[c] || plan.candidates[c].place) continue;
    Information with = information;
    with.add(*slopes[c], weight_of(plan, c));
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
  std::vector<Flow> flows;
  for (std::size_t condition = 0; condition < design.conditions.size(); ++condition) {
    std::optional<Flow> flow = flow_of(design, condition, kept);
    if (!flow) return std::nullopt;
    flows.push_back(std::move(*flow));
  }
  BenchPlan plan;
  plan.whole_rates = task.measured.scale != MeasuredScale::free;
  plan.catch_time = catch_time(flows);
  const MatrixXd points = sobol_points(points_averaged, keys);
  std::vector<Slopes> slopes;
  int usable = 0;
  for (std::size_t c = 0; c < flows.size(); ++c) {
    plan.candidates.push_back({.conditions = design.conditions[c]});
    slopes.push_back(look_at(plan.candidates.back(), flows[c], points, plan, limits.noise));
    if (slopes.back()) ++usable;
  }
  if (usable == 0) throw InputError(fmt::format("{}: nothing flows under any of the settings", task.seeder.string()));
  const int readings = static_cast<int>(limits.time / (plan.catch_time + limits.handling));
  plan.repeats = readings / usual_repeats > static_cast<int>(keys) ? usual_repeats : least_repeats;
  const int wanted = std::min(readings / plan.repeats, usable);
  if (wanted < 1)
    throw InputError(fmt::format("--time: {:g} min are too short for {} readings of {:g} s", limits.time / 60,
                                 least_repeats, plan.catch_time));
  Information information(keys, !plan.whole_rates);
  for (int place = 1; place <= wanted; ++place) {
    const std::size_t best = most_telling(plan, slopes, information);
    plan.candidates[best].place = place;
    information.add(*slopes[best], weight_of(plan, best));
  }
  for (Index k = 0; k < keys; ++k) plan.contraction.push_back(information.contraction(k));
  return plan;
}

}  // namespace vibrosow
