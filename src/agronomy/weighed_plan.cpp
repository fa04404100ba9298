#include "agronomy/weighed_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

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

double predicted_rate(const TableTray& tray, const HoleTable& table) {
  if (const std::string outside = outside_table(tray.at, table); !outside.empty()) throw InputError(outside);
  return mass_rate(tray, table.at(tray.at).value().outflow);
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

/// The factor that weighings tell is of one seed and of holes that were drilled once.
void require_one_tray(const TableTray& first, const TableTray& other) {
  constexpr double same = 1e-6;
  const auto differs = [](double a, double b) { return std::abs(a - b) > same * std::abs(b); };
  if (other.holes != first.holes || differs(other.at.width, first.at.width))
    throw InputError("tray.holes: weighings are of other holes than the first; ask of each tray by itself");
  if (differs(other.seed.diameter, first.seed.diameter) || differs(other.at.aspect, first.at.aspect))
    throw InputError("seeds: weighings are of other seeds than the first; ask of each crop by itself");
  if (differs(other.amplitude, first.amplitude))
    throw InputError("tray.motion.amplitude: weighings differ in it from the first; ask of each amplitude by itself");
}

/// The error that all settings of a tray have in common: what is not chance and interpolation.
PredictionError common_error(const TableTray& tray, const HoleTable& table, const ModelError& model) {
  PredictionError error = table_error(table, tray.at, tray.seed.diameter, model);
  error.chance = 0;
  error.numerics = softness_error(tray.at.aspect) / normal_95;
  return error;
}

}  // namespace

WeighedPlan plan_weighed(double needed, const std::vector<WeighedTray>& weighed, const HoleTable& table,
                         const ModelError& model, const ShakerLimits& limits) {
  const TableTray tray = weighed.front().tray;
  WeighedPlan plan;
  plan.needed = needed;
  std::vector<Weighing> weighings;
  for (const WeighedTray& one : weighed) {
    require_one_tray(tray, one.tray);
    plan.rows.push_back({one, predicted_rate(one.tray, table), 1});
    weighings.push_back({place_of(one.tray), std::log(one.mass_rate / plan.rows.back().predicted), one.deviation,
                         own_deviation(one.tray, table)});
  }
  const PredictionError common = common_error(tray, table, model);
  const double spread = table.factor_spread(kept_open_from);
  const WeighedRates unweighed(common, spread, {}), rates(common, spread, weighings);
  const std::vector<double> surprises = rates.surprise();
  for (std::size_t i = 0; i < surprises.size(); ++i) plan.rows[i].surprise = surprises[i];
  const double own = own_deviation(tray, table);
  plan.before = unweighed.at(own).range;
  const WeighedRates::Answer anew = rates.at(own);
  plan.factor = anew.middle;
  plan.after = {anew.range.low / anew.middle, anew.range.high / anew.middle};

  const Span within{peak_speed(tray, limits.least_frequency), peak_speed(tray, limits.most_frequency)};
  const std::vector<double> speeds = table.speed_steps(tray.at.aspect, within);
  const auto at_speed = [&](double speed) {
    TableTray set = tray;
    set.at.peak_speed = speed;
    set.frequency = frequency_of(set, speed);
    return set;
  };
  const auto corrected = [&](double speed) {
    const TableTray set = at_speed(speed);
    return rates.at(own_deviation(set, table), place_of(set)).middle * predicted_rate(set, table);
  };
  std::vector<double> given;
  for (const double speed : speeds) given.push_back(corrected(speed));
  if (!given.empty()) plan.least = std::ranges::min(given), plan.most = std::ranges::max(given);
  for (std::size_t k = 0; k + 1 < speeds.size(); ++k) {
    if ((given[k] < needed) == (given[k + 1] < needed)) continue;
    std::uintmax_t most_steps = 60;
    const auto [low, high] = boost::math::tools::toms748_solve(
        [&](double speed) { return corrected(speed) - needed; }, speeds[k], speeds[k + 1], given[k] - needed,
        given[k + 1] - needed, boost::math::tools::eps_tolerance<double>(20), most_steps);
    const TableTray set = at_speed(0.5 * (low + high));
    const double predicted = predicted_rate(set, table);
    const FactorRange range = rates.at(own_deviation(set, table), place_of(set)).range;
    plan.settings.push_back(
        {set.frequency, predicted, range.low * predicted, range.high * predicted, given[k] < given[k + 1]});
  }
  return plan;
}

}  // namespace vibrosow
