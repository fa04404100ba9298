#pragma once

#include <optional>
#include <vector>

#include "agronomy/hole_table.hpp"
#include "agronomy/prediction_error.hpp"
#include "agronomy/sowing_plan.hpp"
#include "agronomy/table_tray.hpp"

namespace vibrosow {

/// kg/s of all holes, by the table alone. Throws InputError for a tray outside it.
double predicted_rate(const TableTray& tray, const HoleTable& table);

/// What was weighed (kg/s, of all holes; deviation of its logarithm) beside what the table says of the tray.
Weighing weighing_of(const TableTray& tray, double mass_rate, double deviation, const HoleTable& table);

/// A setting that gives what is needed.
struct CorrectedSetting {
  double frequency = 0;      // Hz
  double width = 0;          // m, of a hole
  double predicted = 0;      // kg/s, by the table alone
  double low = 0, high = 0;  // kg/s, 95 %
  bool more_by_faster = true;
};

/// What a tray gives at settings that it is not at, by the table and by what was weighed of it.
class TrayRates {
 public:
  /// `table` must outlive this.
  TrayRates(const TableTray& tray, const HoleTable& table, const ModelError& model,
            std::vector<Weighing> weighings = {}, const ShakerLimits& limits = {});
  TrayRates(const TableTray& tray, HoleTable&& table, const ModelError& model, std::vector<Weighing> weighings = {},
            const ShakerLimits& limits = {}) = delete;

  const TableTray& tray() const { return tray_; }
  /// Of a setting that is far from all that were weighed, as sure as the tray's own.
  WeighedRates::Answer elsewhere() const;
  /// Of each weighing (WeighedRates::surprise).
  std::vector<double> surprise() const { return rates_.surprise(); }

  /// kg/s of all holes, the least and the most by frequency alone.
  Span reach() const;
  /// Frequencies within the shaker's limits at which all holes give `needed` (kg/s), ascending.
  std::vector<CorrectedSetting> by_frequency(double needed) const;
  /// Another width of the holes that gives it at the tray's own frequency; none where the table has none. Holes that
  /// are drilled anew draw a new tolerance.
  std::optional<CorrectedSetting> by_width(double needed) const;

 private:
  TableTray at_speed(double peak_speed) const;
  TableTray of_width(double width_over_d) const;
  /// `is_drilled_anew`: its holes are others than those that were weighed.
  WeighedRates::Answer answer(const TableTray& set, bool is_drilled_anew) const;
  double corrected(const TableTray& set, bool is_drilled_anew) const;
  CorrectedSetting setting(const TableTray& set, bool is_drilled_anew) const;

  TableTray tray_;
  const HoleTable& table_;
  ModelError model_;
  WeighedRates rates_;
  std::vector<double> speeds_;  // over sqrt(g d), between which outflows bend nowhere
};

}  // namespace vibrosow
