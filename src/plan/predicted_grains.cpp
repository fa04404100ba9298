#include "plan/predicted_grains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "scene/spaces.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

constexpr double flow_constant = 1.25;
constexpr double lost_width_at_rest = 1.9, lost_width_shaken = 1.4;  // mean diameters of a hole that pass nothing
constexpr double steepest_heap = 0.35;                         // tangent; piles of discs stand at 17 to 20 degrees
constexpr double shaken_heap = 0.13;                           // tangent, under the wheat and pea trays' hoppers
constexpr double packing_fraction_3d = 0.6;                    // of a poured bed
constexpr double round_constant = 0.58, slot_constant = 1.03;  // Beverloo's, of the bulk in 3D
constexpr double carried =
    0.55;  // of its peak speed is that of seeds on a shaken floor: 0.45 and 0.7 in reports/relations
constexpr int parts_of_a_run = 2000;

bool is_flat(const Scene& scene) {
  return scene.space == Space::two_dimensional;
}

/// Of the disc, or in 3D the ball, that is as large as the mean grain.
double equal_diameter(const Scene& scene) {
  return is_flat(scene) ? std::sqrt(4 / std::numbers::pi * mean_area(scene.lots))
                        : portable_math::cbrt(6 / std::numbers::pi * mean_volume(scene.lots));
}

/// Grains of a bed over an area (m2) of the plane, in 3D over all of a vessel's depth.
double grains_over(double area, const Scene& scene, const Vessel& vessel) {
  if (is_flat(scene)) return area * poured_share / mean_area(scene.lots);
  return area / vessel.length * floor_area(vessel) * packing_fraction_3d / mean_volume(scene.lots);
}

bool is_shaken(const Vessel& vessel) {
  return vessel.motion && moves(*vessel.motion);
}

double lost_width(const Vessel& vessel) {
  return is_shaken(vessel) ? lost_width_shaken : lost_width_at_rest;
}

/// Grains a second through a hole, see `predicted_outflow`.
double passing(const Hole& hole, const Scene& scene, const Vessel& vessel, double diameter) {
  const double effective = std::max(0.0, hole.width / diameter - lost_width(vessel));
  const double per_second = std::sqrt(standard_gravity / diameter);
  if (is_flat(scene)) return flow_constant * per_second * portable_math::pow(effective, 1.5);
  const double bulk = 6 / std::numbers::pi * packing_fraction_3d;  // grains in a cube of their diameter
  if (hole.shape == HoleShape::round) return round_constant * bulk * per_second * portable_math::pow(effective, 2.5);
  const bool ends = hole.across_length < *vessel.depth * (1 - 1e-9) || vessel.front_and_back != Sides::periodic;
  const double length = std::max(0.0, hole.across_length / diameter - (ends ? lost_width(vessel) : 0));
  return slot_constant * bulk * per_second * length * portable_math::pow(effective, 1.5);
}

double funnel_factor(const Vessel& vessel) {
  return vessel.funnel > std::numbers::pi / 4
             ? portable_math::pow(portable_math::tan(0.5 * std::numbers::pi - vessel.funnel), -0.35)
             : 1;
}

/// What a vessel's holes let through, worked out once for all times.
class HoleRates {
 public:
  HoleRates(const Scene& scene, const Vessel& vessel) : funnel_(funnel_factor(vessel)) {
    if (!vessel.box) return;
    const double diameter = equal_diameter(scene);
    for (const Hole& hole : vessel.holes) holes_.push_back({hole.open_at, passing(hole, scene, vessel, diameter)});
  }

  /// Grains a second.
  double at(double time) const {
    double rate = 0;
    for (const auto& [open_at, own] : holes_)
      if (open_at <= time) rate += own;
    return rate * funnel_;
  }

 private:
  std::vector<std::pair<double, double>> holes_;  // when each opens (s), and grains a second
  double funnel_;
};

double heap_slope(const Scene& scene) {
  return std::min(steepest_heap, scene.contact.seed.friction);
}

/// Area (m2) of what stays on a stretch of flat floor, heaped up towards its middle, or towards a wall at one end of
/// it.
double heap_area(double length, bool against_wall, double slope) {
  return (against_wall ? 0.5 : 0.25) * length * length * slope;
}

/// Grains that holes never drain: heaps between them and at the ends. None where the vessel is shaken or a funnel.
double resting(const Scene& scene, const Vessel& vessel) {
  if (is_shaken(vessel) || vessel.funnel > 0) return 0;
  const double diameter = equal_diameter(scene), slope = heap_slope(scene);
  double area = 0, from = 0;
  bool exit_before = vessel.sides == Sides::open;
  for (const Hole& hole : vessel.holes) {
    if (hole.width <= lost_width(vessel) * diameter) continue;
    area += heap_area(std::max(0.0, hole.centre - 0.5 * hole.width - from), !exit_before, slope);
    from = hole.centre + 0.5 * hole.width;
    exit_before = true;
  }
  area += heap_area(vessel.length - from, vessel.sides != Sides::open, slope);
  return grains_over(area, scene, vessel);
}

double distance_to_holes(const Vessel& vessel, double x) {
  double nearest = vessel.length;
  for (const Hole& hole : vessel.holes)
    nearest = std::min(nearest, std::max(0.0, std::abs(x - hole.centre) - 0.5 * hole.width));
  return nearest;
}

/// How long rain is under way until it is over a hole, s: it falls, and is carried along a floor that is shaken.
double time_to_holes(const Vessel& vessel) {
  if (!vessel.rain || vessel.holes.empty()) return 0;
  const Rain& rain = *vessel.rain;
  const double fall = std::sqrt(2 * std::max(0.0, rain.height) / standard_gravity);
  if (!is_shaken(vessel)) return fall;
  constexpr int places = 100;
  double distance = 0;
  for (int k = 0; k < places; ++k)
    distance += distance_to_holes(vessel, rain.from + (k + 0.5) / places * (rain.to - rain.from)) / places;
  return fall + distance / (carried * motion_bounds(vessel).speed);
}

/// The grains of one vessel as a run goes on.
struct Store {
  const Vessel* vessel;
  HoleRates rates;
  double grains = 0, resting = 0, under_way;  // the last: s, of rain
  bool kept = false;

  Store(const Scene& scene, const Vessel& of)
      : vessel(&of),
        rates(scene, of),
        grains(of.fill ? of.fill->count : 0),
        resting(vibrosow::resting(scene, of)),
        under_way(time_to_holes(of)),
        kept(is_kept(of)) {}

  double rain(double from, double to) const {
    if (!vessel->rain) return 0;
    return vessel->rain->rate * std::max(0.0, std::min(to, vessel->rain->stop) - std::max(from, vessel->rain->start));
  }
  /// What leaves in a time `step` (s), at most `room` grains.
  double let_out(double time, double step, double room) {
    const double staying = resting + rain(time - under_way, time);
    const double most = kept ? room : std::min(room, std::max(0.0, grains - staying));
    const double out = std::min(rates.at(time) * step, most);
    if (!kept) grains -= out;
    return out;
  }
};

/// How many grains a tray takes before its heap closes the hopper above it: a heap that reaches up to the hopper's
/// floor in the middle and slopes to both sides; at least its fill.
double room_under_hopper(const Scene& scene) {
  if (!scene.hopper) return 0;
  const Vessel& tray = scene.tray;
  const double slope = is_shaken(tray) ? shaken_heap : heap_slope(scene);
  const double height = scene.hopper->origin.y() - tray.origin.y() - 0.25 * slope * tray.length;
  const double heaped = grains_over(tray.length * std::max(0.0, height), scene, tray);
  return std::max(heaped, tray.fill ? tray.fill->count : 0.0);
}

}  // namespace

double predicted_outflow(const Scene& scene, const Vessel& vessel, double time) {
  return HoleRates(scene, vessel).at(time);
}

double predicted_grain_steps(const Scene& scene, double dt) {
  Store tray(scene, scene.tray);
  std::optional<Store> hopper;
  if (scene.hopper) hopper.emplace(scene, *scene.hopper);
  const double room = room_under_hopper(scene);
  const double step = scene.run.duration / parts_of_a_run;
  double grain_seconds = 0, since_outflow = 0;
  for (int part = 0; part < parts_of_a_run; ++part) {
    const double time = part * step;
    grain_seconds += step * (tray.grains + (hopper ? hopper->grains : 0));
    const double out = tray.let_out(time, step, 1e300);
    if (hopper) {
      hopper->grains += hopper->rain(time, time + step);
      tray.grains += hopper->let_out(time, step, std::max(0.0, room - tray.grains));
    }
    tray.grains += tray.rain(time, time + step);
    since_outflow = out > 0 ? 0 : since_outflow + step;
    if (scene.run.end_after_pause && since_outflow > *scene.run.end_after_pause) break;
  }
  return grain_seconds / dt;
}

}  // namespace vibrosow
