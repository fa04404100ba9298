#include "calibration/calibration.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "distributions/distributions.hpp"
#include "outflow/statistics.hpp"
#include "scene/input_error.hpp"
#include "surrogate/curve_surrogate.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t points_predicted = 2048;
constexpr double normal_95 = 1.959964;
constexpr double least_freedom = 1;

/// Some values of one measured series that are fitted, or predicted, together.
struct Part {
  std::size_t series = 0;
  bool held_out = false;
  std::vector<std::size_t> values;  // indices in MeasuredSeries::values
  CurveSurrogate surrogate;
  VectorXd measured;              // as simulated values are: logarithms of rates
  double off_basis_variance = 0;  // mean square of what of a fitted curve no simulated one follows
};

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
    judge();
    predict();
    return std::move(result_);
  }

 private:
  const MeasuredSeries& series(std::size_t index) const { return table_.series[index]; }

  bool is_held_out(std::size_t condition, std::size_t s, std::size_t value) const {
    const HoldOut& hold_out = choices_.hold_out;
    if (curves_) return series(s).times[value] > hold_out.after;
    return hold_out.every > 0 && (condition + 1) % static_cast<std::size_t>(hold_out.every) == 0;
  }

  void make_parts() {
    for (std::size_t condition = 0; condition < design_.conditions.size(); ++condition) {
      std::size_t offset = 0;
      for (const std::size_t s : series_of(task_, design_, condition)) {
        const std::size_t count = series(s).values.size();
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
    if (curves_) set_off_basis_variances();
  }

  /// Of a series' fitted part: what was held out must not widen the interval that it is tried by.
  void set_off_basis_variances() {
    for (const Part& fitted : parts_) {
      if (fitted.held_out) continue;
      for (Part& part : parts_)
        if (part.series == fitted.series) part.off_basis_variance = fitted.surrogate.off_components2(fitted.measured);
    }
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
    part.surrogate = curve_surrogate(points, values);
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

  void set_measured(Part& part) const {
    part.measured.resize(static_cast<Index>(part.values.size()));
    for (std::size_t v = 0; v < part.values.size(); ++v)
      part.measured(static_cast<Index>(v)) = transformed(series(part.series).values[part.values[v]].mean);
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

  /// Equal repeats say that the readings are coarse, not that they are exact.
  void take_noise_of_repeats() {
    measured_variance_ = relative_variance_of_repeats();
    if (!measured_variance_) return;
    if (*measured_variance_ > 0) {
      result_.noise_source = "the table's repeats";
    } else {
      measured_variance_.reset();
      result_.noise_source += ", as the table's repeats are all equal";
    }
  }

  void choose_noise() {
    double simulated2 = 0, count = 0;
    for (const Part& part : parts_) {
      const double size = curves_ ? largest(part.series) : 1;
      simulated2 += part.surrogate.chance.trace() / (size * size * static_cast<double>(part.values.size()));
      ++count;
    }
    result_.noise = std::sqrt(simulated2 / count);
    result_.noise_source = "the scatter of simulated runs";
    if (choices_.noise) {
      measured_variance_ = *choices_.noise * *choices_.noise;
      result_.noise_source = curves_ ? "--noise, beside the scatter of simulated runs" : "--noise";
    } else if (!curves_) {
      take_noise_of_repeats();
    }
    if (measured_variance_) result_.noise = std::sqrt(*measured_variance_);
  }

  double repeats_of(const Part& part) const { return series(part.series).repeats[part.values.front()]; }

  /// Of the scores of the mean of so many readings. A measured rate's scatter has the chance of its flow in it already.
  MatrixXd chance_of_scores(const Part& part) const {
    if (!curves_ && measured_variance_) return MatrixXd::Constant(1, 1, *measured_variance_ / repeats_of(part));
    return part.surrogate.chance / repeats_of(part);
  }

  /// Variance of each reading of a curve beside that of its scores: of a reading alone, so that of scores, whose basis
  /// is orthonormal, it is the same.
  double reading_variance(const Part& part) const {
    if (!curves_) return 0;
    const double size = largest(part.series);
    return part.off_basis_variance + measured_variance_.value_or(0) * size * size / repeats_of(part);
  }

  void observe() {
    std::vector<ObservedValues> observed;
    for (const Part& part : parts_) {
      if (part.held_out) continue;
      ObservedValues one;
      for (const GaussianProcess& score : part.surrogate.scores) one.surrogates.push_back(&score);
      one.values = part.surrogate.scores_of(part.measured);
      one.chance = chance_of_scores(part);
      one.chance.diagonal().array() += reading_variance(part);
      one.shifted = task_.measured.scale == MeasuredScale::free;
      result_.fitted_values += static_cast<int>(one.values.size());
      observed.push_back(std::move(one));
    }
    result_.posterior = posterior_sample(observed, static_cast<Index>(task_.keys.size()), choices_.points);
  }

  /// By the best point's misfit. Its degrees of freedom are the values less the numbers that they determine: a key
  /// counts by how much of its range's variance is gone (Spiegelhalter et al. 2002, effective number of parameters).
  /// At least one: as many keys as values meet these to the digit, or else the table lies outside what they can give.
  void judge() {
    double freedom = result_.fitted_values - (result_.depth_factor ? 1 : 0);
    for (const FittedValue& value : result_.values) {
      const double deviation_left = std::min(1.0, 1 - value.contraction);
      freedom -= 1 - deviation_left * deviation_left;
    }
    freedom = std::max(freedom, least_freedom);
    const double misfit = std::max(0.0, result_.posterior.least_misfit);
    result_.misfit_probability = chi_squared_above(freedom, misfit);
    result_.misfit_over_noise = std::sqrt(misfit / freedom);
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
    const CurveSurrogate& surrogate = part.surrogate;
    const MatrixXd points = known.points(drawn, Eigen::all);
    MatrixXd means(points.rows(), static_cast<Index>(surrogate.scores.size()));
    MatrixXd covariance = chance_of_scores(part);
    for (Index k = 0; k < means.cols(); ++k) {
      const GaussianPrediction prediction = surrogate.scores[static_cast<std::size_t>(k)].at(points);
      means.col(k) = prediction.mean;
      covariance(k, k) += prediction.variance.mean();
    }
    MatrixXd values = (means * surrogate.basis.transpose()).rowwise() + surrogate.centre.transpose();
    if (known.shifts.size() > 0) values.colwise() += VectorXd(known.shifts(drawn));
    for (std::size_t v = 0; v < part.values.size(); ++v) {
      const auto at = static_cast<Index>(v);
      const double mean = values.col(at).mean();
      const double between = (values.col(at).array() - mean).square().mean();
      const double within = surrogate.basis.row(at) * covariance * surrogate.basis.row(at).transpose();
      const double half = normal_95 * std::sqrt(between + within + reading_variance(part));
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

Calibration calibrate(const CalibrationTask& task, const CalibrationDesign& design, const CalibrationChoices& choices,
                      const std::vector<ReducedRun>& runs) {
  return Fit(task, design, choices, runs).result();
}

}  // namespace vibrosow
