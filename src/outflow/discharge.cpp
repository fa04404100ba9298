#include "outflow/discharge.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

constexpr int all = -1;

int hole_number(const Scene& scene, const std::string& hole) {
  if (hole == "all") return all;
  int number = 0;
  const auto [end, error] = std::from_chars(hole.data(), hole.data() + hole.size(), number);
  const bool whole = error == std::errc{} && end == hole.data() + hole.size();
  if (!whole || number < 1 || static_cast<std::size_t>(number) > scene.tray.holes.size())
    throw std::invalid_argument("the tray has no hole " + hole);
  return number;
}

int lot_index(const Scene& scene, const std::string& lot) {
  if (lot == "all") return all;
  const auto found = std::ranges::find(scene.lots, lot, &SeedLot::name);
  if (found == scene.lots.end()) throw std::invalid_argument("there are no seeds named " + lot);
  return static_cast<int>(found - scene.lots.begin());
}

double fill_mass(const Scene& scene, int lot) {
  double grains = scene.tray.fill ? scene.tray.fill->count : 0;
  if (scene.hopper && scene.hopper->fill) grains += scene.hopper->fill->count;
  double mass = 0;
  for (std::size_t i = 0; i < scene.lots.size(); ++i)
    if (lot == all || static_cast<std::size_t>(lot) == i)
      mass += scene.lots[i].number_fraction * mean_mass(scene.lots[i]);
  return grains * mass;
}

}  // namespace

std::vector<double> discharge_curve(const Scene& scene, const Run& run, const std::vector<double>& times,
                                    Discharge kind, const std::string& hole, const std::string& lot) {
  const int wanted_hole = hole_number(scene, hole);
  const int wanted_lot = lot_index(scene, lot);
  std::vector<double> event_times;
  std::vector<double> totals = {0.0};
  for (const OutflowEvent& event : run.events) {
    if (event.hole < 1 || (wanted_hole != all && event.hole != wanted_hole)) continue;
    if (wanted_lot != all && event.lot != wanted_lot) continue;
    event_times.push_back(event.time);
    totals.push_back(totals.back() + (kind == Discharge::seeds ? 1 : event.mass));
  }
  const double unit = kind == Discharge::fraction ? fill_mass(scene, wanted_lot) : 1;
  // The last step of a finished run may end a rounding error short of the duration.
  const double end = run.status == RunStatus::finished ? std::max(run.end_time, scene.run.duration) : run.end_time;

  std::vector<double> curve;
  for (const double time : times) {
    const auto passed = std::ranges::upper_bound(event_times, time) - event_times.begin();
    curve.push_back(time > end ? std::numeric_limits<double>::quiet_NaN()
                               : totals[static_cast<std::size_t>(passed)] / unit);
  }
  return curve;
}

}  // namespace vibrosow
