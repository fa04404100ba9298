#include "agronomy/tray_rates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "agronomy/place_giving.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// A length over sqrt(g d): what the peak speed of a frequency is, and back.
double peak_speed(const TableTray& tray, double frequency) {
  return 2 * std::numbers::pi * frequency * tray.amplitude / std::sqrt(standard_gravity * tray.seed.diameter);
}

double frequency_of(const TableTray& tray, double peak) {
  return peak * std::sqrt(standard_gravity * tray.seed.diameter) / (2 * std::numbers::pi * tray.amplitude);
}

/// kg/s, of all holes.
double mass_rate(const TableTray& tray, double outflow) {
  return tray.holes * tray.seed.mass * outflow / std::sqrt(tray.seed.diameter / standard_gravity);
}

/// Deviation of a prediction's logarithm at a setting, from what is its own: chance and interpolation.
double own_deviation(const TableTray& tray, const HoleTable& table) {
  return std::hypot(table.at(tray.at).value().chance,
                    table.interpolation_error(tray.at.aspect, tray.at.width, tray.at.peak_speed)) /
         normal_95;
}

/// Places of the table are about so far apart: twice the speed, three seeds of depth, one of width.
SettingPlace place_of(const TableTray& tray) {
  return {std::log2(tray.at.peak_speed), tray.at.depth / 3, tray.at.width};
}

/// The error of a tray's settings but for chance and interpolation, which each has of its own.
PredictionError common_error(const TableTray& tray, const HoleTable& table, const ModelError& model) {
  PredictionError error = table_error(table, tray.at, tray.seed.diameter, model);
  error.chance = 0;
  error.numerics = std::hypot(softness_error(tray.at.aspect) / normal_95, table.multiplied_by().deviation);
  return error;
}

}  // namespace

double predicted_rate(const TableTray& tray, const HoleTable& table) {
  if (const std::string outside = outside_table(tray.at, table); !outside.empty()) throw InputError(outside);
  return mass_rate(tray, table.at(tray.at).value().outflow);
}

Weighing weighing_of(const TableTray& tray, double mass_rate, double deviation, const HoleTable& table) {
  return {place_of(tray), std::log(mass_rate / predicted_rate(tray, table)), deviation, own_deviation(tray, table)};
}

TrayRates::TrayRates(const TableTray& tray, const HoleTable& table, const ModelError& model,
                     std::vector<Weighing> weighings, const ShakerLimits& limits)
    : tray_(tray), table_(table), model_(model), rates_(common_error(tray_, table, model), std::move(weighings)) {
  const Span within{peak_speed(tray_, limits.least_frequency), peak_speed(tray_, limits.most_frequency)};
  speeds_ = table.speed_steps(tray_.at.aspect, within);
}

WeighedRates::Answer TrayRates::elsewhere() const {
  return rates_.at(own_deviation(tray_, table_));
}

TableTray TrayRates::at_speed(double peak) const {
  TableTray set = tray_;
  set.at.peak_speed = peak;
  set.frequency = frequency_of(set, peak);
  return set;
}

TableTray TrayRates::of_width(double width_over_d) const {
  TableTray set = tray_;
  set.at.width = width_over_d;
  return set;
}

WeighedRates::Answer TrayRates::answer(const TableTray& set, bool is_drilled_anew) const {
  std::optional<double> tolerance;
  if (is_drilled_anew) tolerance = table_error(table_, set.at, set.seed.diameter, model_).tolerance;
  return rates_.at(own_deviation(set, table_), place_of(set), tolerance);
}

double TrayRates::corrected(const TableTray& set, bool is_drilled_anew) const {
  return answer(set, is_drilled_anew).middle * predicted_rate(set, table_);
}

CorrectedSetting TrayRates::setting(const TableTray& set, bool is_drilled_anew) const {
  const double predicted = predicted_rate(set, table_);
  const FactorRange range = answer(set, is_drilled_anew).range;
  return {set.frequency, set.at.width * set.seed.diameter, predicted, range.low * predicted, range.high * predicted};
}

Span TrayRates::reach() const {
  if (speeds_.empty()) return {};
  Span reach{corrected(at_speed(speeds_.front()), false), 0};
  for (const double speed : speeds_) {
    const double rate = corrected(at_speed(speed), false);
    reach = {std::min(reach.least, rate), std::max(reach.most, rate)};
  }
  return reach;
}

std::vector<CorrectedSetting> TrayRates::by_frequency(double needed) const {
  const auto rate = [&](double speed) { return corrected(at_speed(speed), false); };
  std::vector<double> given;
  for (const double speed : speeds_) given.push_back(rate(speed));
  std::vector<CorrectedSetting> settings;
  for (std::size_t k = 0; k + 1 < speeds_.size(); ++k) {
    if ((given[k] < needed) == (given[k + 1] < needed)) continue;
    const TableTray set = at_speed(place_giving(needed, speeds_[k], speeds_[k + 1], rate));
    settings.push_back(setting(set, false));
    settings.back().more_by_faster = given[k] < given[k + 1];
  }
  return settings;
}

std::optional<CorrectedSetting> TrayRates::by_width(double needed) const {
  const Span widths = table_.widths(tray_.at.aspect);
  const auto rate = [&](double width) { return corrected(of_width(width), true); };
  if (!Span{rate(widths.least), rate(widths.most)}.holds(needed)) return std::nullopt;
  const TableTray set = of_width(place_giving(needed, widths.least, widths.most, rate));
  return setting(set, true);
}

}  // namespace vibrosow
