#include "agronomy/weighed_plan.hpp"

#include <cmath>
#include <utility>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// The factor that weighings tell is of one seed and of holes that were drilled once.
void require_one_tray(const TableTray& tray, const TableTray& weighed) {
  constexpr double same = 1e-6;
  const auto differs = [](double a, double b) { return std::abs(a - b) > same * std::abs(b); };
  if (weighed.holes != tray.holes || differs(weighed.at.width, tray.at.width))
    throw InputError("tray.holes: weighings are of other holes than the layout's; ask of each tray by itself");
  if (differs(weighed.seed.diameter, tray.seed.diameter) || differs(weighed.at.aspect, tray.at.aspect))
    throw InputError("seeds: weighings are of other seeds than the layout's; ask of each crop by itself");
  if (differs(weighed.amplitude, tray.amplitude))
    throw InputError("tray.motion.amplitude: weighings are of another than the layout's; ask of each by itself");
}

}  // namespace

TrayRates weighed_rates(const TableTray& tray, const std::vector<WeighedTray>& weighed, const HoleTable& table,
                        const ModelError& model, const ShakerLimits& limits) {
  std::vector<Weighing> weighings;
  for (const WeighedTray& one : weighed) {
    require_one_tray(tray, one.tray);
    weighings.push_back(weighing_of(one.tray, one.mass_rate, one.deviation, table));
  }
  return TrayRates(tray, table, model, std::move(weighings), limits);
}

WeighedPlan plan_weighed(double needed, const TableTray& tray, const std::vector<WeighedTray>& weighed,
                         const HoleTable& table, const ModelError& model, const ShakerLimits& limits) {
  const TrayRates rates = weighed_rates(tray, weighed, table, model, limits);
  const TrayRates unweighed(tray, table, model, {}, limits);
  WeighedPlan plan;
  plan.needed = needed;
  plan.hole_width = tray.at.width * tray.seed.diameter;
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
