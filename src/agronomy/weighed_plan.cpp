#include "agronomy/weighed_plan.hpp"

#include <cmath>
#include <utility>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

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

}  // namespace

TrayRates weighed_rates(const std::vector<WeighedTray>& weighed, const HoleTable& table, const ModelError& model,
                        const ShakerLimits& limits) {
  const TableTray& tray = weighed.front().tray;
  std::vector<Weighing> weighings;
  for (const WeighedTray& one : weighed) {
    require_one_tray(tray, one.tray);
    weighings.push_back(weighing_of(one.tray, one.mass_rate, one.deviation, table));
  }
  return TrayRates(tray, table, model, table.factor_spread(kept_open_from), std::move(weighings), limits);
}

WeighedPlan plan_weighed(double needed, const std::vector<WeighedTray>& weighed, const HoleTable& table,
                         const ModelError& model, const ShakerLimits& limits) {
  const TrayRates rates = weighed_rates(weighed, table, model, limits);
  const TrayRates unweighed(rates.tray(), table, model, table.factor_spread(kept_open_from), {}, limits);
  WeighedPlan plan;
  plan.needed = needed;
  const std::vector<double> surprises = rates.surprise();
  for (std::size_t i = 0; i < weighed.size(); ++i)
    plan.rows.push_back({weighed[i], predicted_rate(weighed[i].tray, table), surprises[i]});
  plan.before = unweighed.elsewhere().range;
  const WeighedRates::Answer anew = rates.elsewhere();
  plan.factor = anew.middle;
  plan.after = {anew.range.low / anew.middle, anew.range.high / anew.middle};
  plan.reach = rates.reach();
  plan.settings = rates.by_frequency(needed);
  return plan;
}

}  // namespace vibrosow
