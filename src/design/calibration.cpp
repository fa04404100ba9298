#include "design/calibration.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include <fmt/format.h>

#include "design/comparison.hpp"
#include "outflow/statistics.hpp"
#include "plan/model.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double variance_kept = 0.999;  // by the principal components of a curve
constexpr Index most_components = 6;
constexpr std::size_t points_predicted = 512;
constexpr double normal_95 = 1.959964;

/// Some values of one measured series that are fitted, or predicted, together, as a plane through the simulated ones:
/// centre + basis * scores. A rate is its own score.
struct Part {
  std::size_t series = 0;
  bool held_out = false;
  std::vector<std::size_t> values;  // indices in MeasuredSeries::values
  VectorXd centre;
  MatrixXd basis;                           // orthonormal columns
  std::vector<GaussianProcess> surrogates;  // of the scores
  MatrixXd chance;                          // covariance of the scores of one run
  VectorXd measured;                        // as simulated values are: logarithms of rates
  double strange2 = 0;                      // mean square of what of it lies off the plane
};

/// Indices of the series that were measured under a condition.
std::vector<std::size_t> series_of(const CalibrationTask& task, const CalibrationDesign& design,
                                   std::size_t condition) {
  const std::vector<MeasuredSeries>& all = task.measured.table.series;
  std::vector<std::size_t> indices;
  for (std::size_t s = 0; s < all.size(); ++s)
    if (all[s].conditions == design.conditions[condition]) indices.push_back(s);
  return indices;
}

ReducedRun reduced_run(const CalibrationTask& task, const std::vector<std::size_t>& series, const Scene& scene,
                       const Evaluation& evaluation) {
  ReducedRun reduced;
  if (!evaluation.finished()) {
    reduced.reason = evaluation.reason;
    return reduced;
  }
  if (evaluation.outside_the_model) reduced.reason = "outside the model";
  const bool curves = is_curve(task.measured.table.quantity);
  const double factor = task.measured.scale == MeasuredScale::depth ? evaluation.outflow.depth_factor.value_or(1) : 1;
  for (const std::size_t s : series) {
    std::vector<double> values = simulated_values(evaluation, task.measured, task.measured.table.series[s], scene);
    for (double& value : values) value *= factor;
    if (!std::ranges::all_of(values, [&](double value) { return std::isfinite(value) && (curves || value > 0); }))
      reduced.reason = "nothing flowed";
    reduced.values.insert(reduced.values.end(), values.begin(), values.end());
  }
  return reduced;
}

/// The scene that a condition's runs have but for the fitted keys.
const Scene& scene_of(const CalibrationDesign& design, std::size_t condition) {
  return std::ranges::find(design.runs, condition, &CalibrationRun::condition)->scene;
}

/// How many of a series' values lie within the run.
std::size_t values_within(const CalibrationTask& task, const MeasuredSeries& series, const Scene& scene) {
  if (!is_curve(task.measured.table.quantity)) return 1;
  return curve_request(task.measured, series, scene).times.size() - 1;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

class Fit {
 public:
  Fit(const CalibrationTask& task, const CalibrationDesign& design, const CalibrationChoices& choices,
      const std::vector<ReducedRun>& runs)
      : task_(task),
        design_(design),
        choices_(choices),
        runs_(runs),
        table_(task.measured.table),
        curves_(is_curve(table_.quantity)) {}

  Calibration result() {
    make_parts();
    choose_noise();
    observe();
    describe();
    predict();
    return std::move(result_);
  }

 private:
  const MeasuredSeries& series(std::size_t index) const { return table_.series[index]; }

  std::vector<std::size_t> series_of(std::size_t condition) const {
    return vibrosow::series_of(task_, design_, condition);
  }

  bool is_held_out(std::size_t condition, std::size_t s, std::size_t value) const {
    const HoldOut& hold_out = choices_.hold_out;
    if (curves_) return series(s).times[value] > hold_out.after;
    return hold_out.every > 0 && (condition + 1) % static_cast<std::size_t>(hold_out.every) == 0;
  }

  void make_parts() {
    for (std::size_t condition = 0; condition < design_.conditions.size(); ++condition) {
      std::size_t offset = 0;
      for (const std::size_t s : series_of(condition)) {
        const std::size_t count = values_within(task_, series(s), scene_of(design_, condition));
        for (const bool held_out : {false, true}) {
          Part part;
          part.series = s, part.held_out = held_out;
          for (std::size_t v = 0; v < count; ++v)
            if (is_held_out(condition, s, v) == held_out) part.values.push_back(v);
          if (!part.values.empty()) parts_.push_back(trained(std::move(part), condition, offset));
        }
        offset += count;
      }
    }
    if (std::ranges::all_of(parts_, &Part::held_out))
      throw InputError(fmt::format("{}: all of it is held out", task_.measured.file.string()));
  }

  /// `offset`: of the series' values in those of a run.
  Part trained(Part part, std::size_t condition, std::size_t offset) const {
    std::vector<Index> rows;
    std::vector<VectorXd> simulated;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const ReducedRun& run = runs_[r];
      if (design_.runs[r].condition != condition || !run.reason.empty()) continue;
      VectorXd values(static_cast<Index>(part.values.size()));
      for (std::size_t v = 0; v < part.values.size(); ++v)
        values(static_cast<Index>(v)) = transformed(run.values[offset + part.values[v]]);
      rows.push_back(design_.runs[r].point);
      simulated.push_back(std::move(values));
    }
    const auto count = static_cast<Index>(rows.size());
    const auto keys = static_cast<Index>(task_.keys.size());
    if (count < keys + 4)
      throw InputError(fmt::format("{}: only {} of the runs under its conditions can be used, too few for {} keys{}",
                                   series(part.series).where, count, keys, first_reason(condition)));
    MatrixXd points(count, keys), values(count, static_cast<Index>(part.values.size()));
    for (Index i = 0; i < count; ++i) {
      points.row(i) = design_.points.row(rows[static_cast<std::size_t>(i)]);
      values.row(i) = simulated[static_cast<std::size_t>(i)].transpose();
    }
    set_plane(part, values);
    const MatrixXd scores = (values.rowwise() - part.centre.transpose()) * part.basis;
    MatrixXd errors(count, scores.cols());
    for (Index k = 0; k < scores.cols(); ++k) {
      part.surrogates.emplace_back(points, scores.col(k));
      errors.col(k) = part.surrogates.back().left_out_errors();
    }
    set_chance(part, errors);
    set_measured(part);
    return part;
  }

  std::string first_reason(std::size_t condition) const {
    for (std::size_t r = 0; r < runs_.size(); ++r)
      if (design_.runs[r].condition == condition && !runs_[r].reason.empty())
        return fmt::format(" ({})", runs_[r].reason);
    return "";
  }

  double transformed(double value) const { return curves_ ? value : std::log(value); }

  void set_plane(Part& part, const MatrixXd& values) const {
    part.centre = values.colwise().mean().transpose();
    const MatrixXd centred = values.rowwise() - part.centre.transpose();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(centred.transpose() * centred);
    const VectorXd variances = solver.eigenvalues().cwiseMax(0.0);  // ascending
    const double all = variances.sum();
    Index components = 0;
    double kept = 0;
    while (components < std::min(most_components, variances.size()) && (components == 0 || kept < variance_kept * all))
      kept += variances(variances.size() - 1 - components++);
    part.basis = solver.eigenvectors().rightCols(components).rowwise().reverse();
    for (Index k = 0; k < components; ++k)  // the sign of an eigenvector is nobody's choice
      if (part.basis.col(k).sum() < 0) part.basis.col(k) *= -1;
  }

  /// Scores of one run share its chance: their correlation is that of what the surrogates miss.
  static void set_chance(Part& part, const MatrixXd& errors) {
    const Index count = errors.cols();
    part.chance.resize(count, count);
    for (Index a = 0; a < count; ++a)
      for (Index b = 0; b < count; ++b) {
        const double norm = std::sqrt(errors.col(a).squaredNorm() * errors.col(b).squaredNorm());
        const double correlation = a == b || norm == 0 ? (a == b ? 1 : 0) : errors.col(a).dot(errors.col(b)) / norm;
        part.chance(a, b) = correlation * std::sqrt(part.surrogates[static_cast<std::size_t>(a)].noise() *
                                                    part.surrogates[static_cast<std::size_t>(b)].noise());
      }
  }

  void set_measured(Part& part) const {
    part.measured.resize(static_cast<Index>(part.values.size()));
    for (std::size_t v = 0; v < part.values.size(); ++v)
      part.measured(static_cast<Index>(v)) = transformed(series(part.series).values[part.values[v]].mean);
    if (!curves_) return;
    const VectorXd from_centre = part.measured - part.centre;
    const VectorXd off = from_centre - part.basis * (part.basis.transpose() * from_centre);
    part.strange2 = off.squaredNorm() / static_cast<double>(off.size());
  }

  double largest(std::size_t s) const {
    double most = 0;
    for (const MeanWithInterval& value : series(s).values) most = std::max(most, value.mean);
    return most;
  }

  /// Square of the relative deviation of single readings, pooled over the table's repeats; none without any.
  std::optional<double> relative_variance_of_repeats() const {
    double squares = 0, freedom = 0;
    for (const MeasuredSeries& one : table_.series)
      for (std::size_t v = 0; v < one.values.size(); ++v) {
        const int repeats = one.repeats[v];
        if (repeats < 2 || one.values[v].mean <= 0) continue;
        const double deviation =
            *one.values[v].half_width_95 / student_t_95(repeats - 1) * std::sqrt(repeats) / one.values[v].mean;
        squares += (repeats - 1) * deviation * deviation;
        freedom += repeats - 1;
      }
    return freedom > 0 ? std::optional(squares / freedom) : std::nullopt;
  }

  void choose_noise() {
    double simulated2 = 0, count = 0;
    for (const Part& part : parts_) {
      const double size = curves_ ? largest(part.series) : 1;
      simulated2 += part.chance.trace() / (size * size * static_cast<double>(part.values.size()));
      ++count;
    }
    result_.noise = std::sqrt(simulated2 / count);
    result_.noise_source = "the scatter of simulated runs";
    if (choices_.noise) {
      measured_variance_ = *choices_.noise * *choices_.noise;
      result_.noise_source = curves_ ? "--noise, beside the scatter of simulated runs" : "--noise";
    } else if (!curves_) {
      measured_variance_ = relative_variance_of_repeats();
      if (measured_variance_) result_.noise_source = "the table's repeats";
    }
    if (measured_variance_) result_.noise = std::sqrt(*measured_variance_);
  }

  /// Of the scores of the mean of so many readings. A measured rate's scatter has the chance of its flow in it already.
  MatrixXd chance_of_measured(const Part& part) const {
    const double repeats = series(part.series).repeats[part.values.front()];
    if (!curves_ && measured_variance_) return MatrixXd::Constant(1, 1, *measured_variance_ / repeats);
    MatrixXd chance = part.chance / repeats;
    const double size = largest(part.series);
    chance.diagonal().array() += part.strange2 + (curves_ ? measured_variance_.value_or(0) * size * size / repeats : 0);
    return chance;
  }

  void observe() {
    std::vector<ObservedValues> observed;
    for (const Part& part : parts_) {
      if (part.held_out) continue;
      ObservedValues one;
      for (const GaussianProcess& surrogate : part.surrogates) one.surrogates.push_back(&surrogate);
      one.values = part.basis.transpose() * (part.measured - part.centre);
      one.chance = chance_of_measured(part);
      one.shifted = task_.measured.scale == MeasuredScale::free;
      result_.fitted_values += static_cast<int>(one.values.size());
      observed.push_back(std::move(one));
    }
    result_.posterior = posterior_sample(observed, static_cast<Index>(task_.keys.size()), choices_.points);
    const int freedom = result_.fitted_values - (result_.posterior.shifts.size() > 0 ? 1 : 0);
    if (freedom > 0)
      result_.misfit_probability =
          cdf(complement(boost::math::chi_squared(freedom), std::max(0.0, result_.posterior.least_misfit)));
  }

  /// Of a quantity given at each point of the posterior.
  FittedValue fitted(const VectorXd& at_points) const {
    const VectorXd& weights = result_.posterior.weights;
    return {weighted_mean(at_points, weights), weighted_quantile(at_points, weights, 0.025),
            weighted_quantile(at_points, weights, 0.975), 0};
  }

  void describe() {
    const PosteriorSample& known = result_.posterior;
    std::vector<VectorXd> columns;
    for (std::size_t k = 0; k < task_.keys.size(); ++k) {
      const VectorXd parts = known.points.col(static_cast<Index>(k));
      const VectorXd values = parts.unaryExpr([&](double part) { return task_.keys[k].at(part); });
      result_.values.push_back(fitted(values));
      result_.values.back().contraction = 1 - weighted_deviation(parts, known.weights) * std::sqrt(12.0);
      columns.push_back(parts);
    }
    if (known.shifts.size() > 0) {
      result_.depth_factor = fitted(known.shifts.array().exp());
      result_.depth_factor->contraction = 1;  // of a prior without end
      columns.push_back(known.shifts);
    }
    for (std::size_t b = 1; b < columns.size(); ++b)
      for (std::size_t a = 0; a < b; ++a)
        result_.correlations.push_back({a, b, weighted_correlation(columns[a], columns[b], known.weights)});
  }

  void predict() {
    const std::vector<Index> drawn = points_of_equal_weight(result_.posterior.weights, points_predicted);
    for (const Part& part : parts_) predict(part, drawn);
    std::ranges::stable_sort(result_.predictions, {}, [](const PredictedValue& value) {
      return std::pair(value.series, value.time.value_or(0));
    });
    result_.fitted_rms = rms(false);
    result_.held_out_rms = rms(true);
  }

  void predict(const Part& part, const std::vector<Index>& drawn) {
    const PosteriorSample& known = result_.posterior;
    const MatrixXd points = known.points(drawn, Eigen::all);
    MatrixXd means(points.rows(), static_cast<Index>(part.surrogates.size()));
    MatrixXd covariance = chance_of_measured(part);
    for (Index k = 0; k < means.cols(); ++k) {
      const GaussianPrediction prediction = part.surrogates[static_cast<std::size_t>(k)].at(points);
      means.col(k) = prediction.mean;
      covariance(k, k) += prediction.variance.mean();
    }
    MatrixXd values = (means * part.basis.transpose()).rowwise() + part.centre.transpose();
    if (known.shifts.size() > 0) values.colwise() += VectorXd(known.shifts(drawn));
    for (std::size_t v = 0; v < part.values.size(); ++v) {
      const auto at = static_cast<Index>(v);
      const double mean = values.col(at).mean();
      const double between = (values.col(at).array() - mean).square().mean();
      const double within = part.basis.row(at) * covariance * part.basis.row(at).transpose();
      const double half = normal_95 * std::sqrt(between + within + part.strange2);
      const auto back = [&](double value) { return curves_ ? value : std::exp(value); };
      const MeasuredSeries& of = series(part.series);
      result_.predictions.push_back({part.series, curves_ ? std::optional(of.times[part.values[v]]) : std::nullopt,
                                     part.held_out, of.values[part.values[v]].mean, back(mean), back(mean - half),
                                     back(mean + half)});
    }
  }

  /// Of what was held out, or fitted.
  std::optional<double> rms(bool held_out) const {
    double squares = 0, count = 0;
    for (const PredictedValue& value : result_.predictions) {
      if (value.held_out != held_out) continue;
      const double error = (value.predicted - value.measured) / (curves_ ? largest(value.series) : value.measured);
      squares += error * error;
      ++count;
    }
    return count > 0 ? std::optional(std::sqrt(squares / count)) : std::nullopt;
  }

  const CalibrationTask& task_;
  const CalibrationDesign& design_;
  const CalibrationChoices& choices_;
  const std::vector<ReducedRun>& runs_;
  const MeasuredTable& table_;
  bool curves_;
  std::vector<Part> parts_;
  std::optional<double> measured_variance_;  // relative, of one reading
  Calibration result_;
};

}  // namespace

HoldOut usual_hold_out(const MeasuredTable& table) {
  HoldOut hold_out;
  if (is_curve(table.quantity)) {
    double last = 0;
    for (const MeasuredSeries& series : table.series) last = std::max(last, series.times.back());
    hold_out.after = 0.75 * last;
  } else {
    hold_out.every = 4;
  }
  return hold_out;
}

std::optional<std::vector<ReducedRun>> reduced_runs(const CalibrationTask& task, const CalibrationDesign& design,
                                                    const Simulator& kept) {
  std::vector<ReducedRun> reduced;
  for (const CalibrationRun& run : design.runs) {
    const std::vector<std::size_t> series = series_of(task, design, run.condition);
    std::vector<CurveRequest> requests;
    if (is_curve(task.measured.table.quantity))
      for (const std::size_t s : series)
        requests.push_back(curve_request(task.measured, task.measured.table.series[s], run.scene));
    SimulationOptions options;
    options.random_seed = run.random_seed;
    const Evaluation evaluation = evaluate(prepare_to_run(run.scene), options, requests, kept);
    if (evaluation.status == EvaluationStatus::not_begun || evaluation.status == EvaluationStatus::interrupted)
      return std::nullopt;
    reduced.push_back(reduced_run(task, series, run.scene, evaluation));
  }
  leave_out_clogged(task, design, reduced);
  return reduced;
}

void leave_out_clogged(const CalibrationTask& task, const CalibrationDesign& design, std::vector<ReducedRun>& runs) {
  constexpr double share_to_go = 0.1;
  if (!is_curve(task.measured.table.quantity)) return;
  for (std::size_t condition = 0; condition < design.conditions.size(); ++condition) {
    std::vector<std::size_t> of_condition;
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (design.runs[r].condition == condition && runs[r].reason.empty()) of_condition.push_back(r);
    if (of_condition.empty()) continue;
    std::size_t first = 0;  // of the series' values in those of a run
    for (const std::size_t s : series_of(task, design, condition)) {
      const std::size_t count = values_within(task, task.measured.table.series[s], scene_of(design, condition));
      std::vector<double> medians;
      for (std::size_t v = first; v < first + count; ++v) {
        std::vector<double> values;
        for (const std::size_t r : of_condition) values.push_back(runs[r].values[v]);
        medians.push_back(median(std::move(values)));
      }
      for (const std::size_t r : of_condition) {
        std::size_t last = count - 1;  // after which nothing leaves
        while (last > 0 && runs[r].values[first + last - 1] == runs[r].values[first + count - 1]) --last;
        if (medians.back() - medians[last] > share_to_go * medians.back()) runs[r].reason = "clogged";
      }
      first += count;
    }
  }
}

Calibration calibrate(const CalibrationTask& task, const CalibrationDesign& design, const CalibrationChoices& choices,
                      const std::vector<ReducedRun>& runs) {
  return Fit(task, design, choices, runs).result();
}

}  // namespace vibrosow
