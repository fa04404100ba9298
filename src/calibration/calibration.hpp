#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_runs.hpp"
#include "surrogate/posterior_sample.hpp"

namespace vibrosow {

/// Which part of a measured table is not fitted, and is predicted instead.
struct HoldOut {
  int every = 0;                                           // each so many-th condition; 0: none
  double after = std::numeric_limits<double>::infinity();  // s of a curve's time
};

/// Every fourth condition where there are four; of curves the last quarter of the time.
HoldOut usual_hold_out(const MeasuredTable& table);

struct CalibrationChoices {
  HoldOut hold_out{};
  std::optional<double> noise{};  // relative standard deviation of a measured rate; of a curve's values, of the curve's
                                  // largest; none: from the table's repeats, else the scatter of simulated runs
  Eigen::Index points = 16384;    // of the posterior
};

/// What is known of a number afterwards.
struct FittedValue {
  double mean = 0;
  double low = 0, high = 0;  // its 95 % interval
  double contraction = 0;    // 1 - standard deviation over that of the prior
};

/// A measured value beside what the fitted model says of it; SI, scaled.
struct PredictedValue {
  std::size_t series;          // index in MeasuredTable::series
  std::optional<double> time;  // s, of a curve
  bool held_out;
  double measured;
  double predicted, low, high;  // the 95 % interval of a measurement with as many repeats
};

/// Two keys, indices in CalibrationTask::keys, or one and the depth factor (the number of keys).
struct FittedPair {
  std::size_t a, b;
  double correlation;
};

struct Calibration {
  std::vector<FittedValue> values;          // of CalibrationTask::keys, in the unit of the key's column
  std::optional<FittedValue> depth_factor;  // where it is fitted: what a plane slice's rates are multiplied by
  std::vector<FittedPair> correlations;     // of every pair
  std::vector<PredictedValue> predictions;  // by series, then time
  PosteriorSample posterior;
  double noise = 0;              // of one measured rate, relative; of curves of a simulated one, a fraction of the most
  std::string noise_source;      // where it is from
  int fitted_values = 0;         // numbers in the likelihood; a curve's are its principal components
  double misfit_over_noise = 0;  // root mean square of the best point's misfits, each over its own noise
  double misfit_probability = 1;  // of a misfit as large as the best point's, were the model right (chi squared)
  std::optional<double> fitted_rms,
      held_out_rms;  // of predictions: relative of rates; of curves of their largest value
};

/// Two values above this correlation cannot be told apart by the table.
inline constexpr double not_told_apart = 0.8;

/// Fits a Gaussian process to the simulated values of each condition and weighs the keys' ranges with the measured
/// ones. Rates are fitted in their logarithm, curves by their principal components (those that make up 99.9 % of the
/// runs' differences, six at most); what of a measured curve no simulated one follows counts as noise. `runs`: of the
/// design's, in order. Throws InputError where too few runs count.
Calibration calibrate(const CalibrationTask& task, const CalibrationDesign& design, const CalibrationChoices& choices,
                      const std::vector<ReducedRun>& runs);

}  // namespace vibrosow
