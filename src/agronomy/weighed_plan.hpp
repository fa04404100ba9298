#pragma once

#include <vector>

#include "agronomy/hole_table.hpp"
#include "agronomy/prediction_error.hpp"
#include "agronomy/tray_rates.hpp"

namespace vibrosow {

/// A tray's rate as it was weighed.
struct WeighedTray {
  TableTray tray;
  double mass_rate = 0;        // kg/s, of all its holes
  double deviation = 0;        // of its logarithm
  double repeats_scatter = 0;  // standard deviation of the repeats that it is the mean of, over it
};

/// What is said of it.
struct WeighedRow {
  WeighedTray weighed;
  double predicted = 0;  // kg/s
  double surprise = 1;   // how likely such a rate is by all the others, and the model's error; see WeighedRates
};

struct WeighedPlan {
  double needed = 0;      // kg/s, of all holes of the tray
  double hole_width = 0;  // m
  std::vector<WeighedRow> rows;
  double factor = 1;              // truth over the table at a setting far from these, middle
  FactorRange before{}, after{};  // of a setting far from these, over what is predicted and over `factor`
  std::vector<CorrectedSetting> settings;
  Span reach{};  // kg/s, corrected, within the shaker's limits
};

/// What a tray gives of which rows, in any order, were weighed at other frequencies and depths of its bed. Throws
/// InputError where a row is of another tray, and where the table, which must outlive the rates, does not tell of one.
TrayRates weighed_rates(const TableTray& tray, const std::vector<WeighedTray>& weighed, const HoleTable& table,
                        const ModelError& model, const ShakerLimits& limits = {});

/// What to set a tray to that was weighed, for `needed` (kg/s, of all its holes). Throws as `weighed_rates` does.
WeighedPlan plan_weighed(double needed, const TableTray& tray, const std::vector<WeighedTray>& weighed,
                         const HoleTable& table, const ModelError& model, const ShakerLimits& limits = {});

/// Above it the repeats of a weighing contradict each other: a scale and a clock err by some 2 %.
inline constexpr double contradicting_scatter = 0.1;

/// Below it a weighing contradicts the others.
inline constexpr double surprising = 0.01;

}  // namespace vibrosow
