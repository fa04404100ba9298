#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accuracy/accuracy_settings.hpp"
#include "accuracy/depth_error.hpp"
#include "accuracy/error_fit.hpp"
#include "outflow/statistics.hpp"

namespace vibrosow {

/// A setting and what its runs gave.
struct AccuracyRow {
  AccuracySetting setting;
  bool too_long = false;                      // its step is refused, so it is not run
  std::string refused;                        // why it has no rate: a step too long, stopped by the guard, interrupted
  int replicates = 0;                         // runs that have a rate
  std::optional<MeanWithInterval> mass_rate;  // kg/s, all holes and lots, of the plane slice or in 3D of the tray
  std::optional<double> error_percent;        // signed, against the reference
  std::optional<double>
      error_ci95;  // half width, percent: both rates' intervals, as independent; none for the reference
  std::optional<RateError> fitted;   // error against the limit, by the fit of main effects
  double grain_steps = 0;            // mean of the runs
  std::optional<double> cost_ratio;  // grain-steps times force evaluations a step, over the reference's
  bool on_front = false;             // errs less, beyond chance, than every cheaper setting on the front
  double cpu_time = 0;               // s, mean of the runs made now; of this machine; 0: all were kept from before
};

struct AccuracyResult {
  std::vector<AccuracyRow> rows;      // of the settings that were to be run, in the order of the design
  std::vector<AccuracyRun> runs;      // their setting: index in `rows`
  std::size_t reference = 0;          // index of the finest setting whose step is not too long; it may have no rate
  std::optional<ErrorFit> fit;        // none: too few runs, or
  std::string_view of_one_value;      // what all runs have one value of (`part_of_one_value`)
  std::optional<DepthError> depth{};  // where it was asked for
};

/// Runs a design so many rounds and fits it. A setting whose step is too long is not run. Throws InputError when no
/// setting can be run.
AccuracyResult measure_accuracy(const Scene& scene, const AccuracyDesign& design, int rounds,
                                const Simulator& simulator, const SweepOptions& options);

/// The rows and the fit of runs that were made of settings; `refused`: of each setting, why it was not run, or empty.
AccuracyResult accuracy_of(const std::vector<AccuracySetting>& settings, const std::vector<std::string>& refused,
                           std::vector<AccuracyRun> runs);

/// Sets the reference and, where that has a rate, errors, cost ratios and the front, from rates and grain-steps. The
/// reference: of the settings whose step is not too long, the stiffest, then the one of smallest slip speed, then
/// velocity Verlet, then the most steps a contact.
void compare_with_finest(AccuracyResult& result);

/// The cheapest row, by grain-steps and evaluations, whose fitted error with its band stays within `percent`.
std::optional<std::size_t> cheapest_within(const AccuracyResult& result, double percent);

}  // namespace vibrosow
