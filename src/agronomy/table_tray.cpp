#include "agronomy/table_tray.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "scene/input_error.hpp"
#include "scene/spaces.hpp"

namespace vibrosow {
namespace {

constexpr double told_depth = 0.01;     // d, finer than a whole number of seeds says how deep they lie
constexpr double poured_packing = 0.6;  // by which the number of seeds is called a depth, as of the table's runs

[[noreturn]] void refuse(const char* key, const char* why) {
  throw InputError(fmt::format("{}: {}; the table of one hole does not cover that", key, why));
}

/// Null of a tray that stands still or moves otherwise.
const HarmonicMotion* shaking(const Vessel& tray) {
  const auto* motion = tray.motion ? std::get_if<HarmonicMotion>(&*tray.motion) : nullptr;
  return motion != nullptr && motion->amplitude > 0 && motion->frequency > 0 ? motion : nullptr;
}

bool is_level(double angle) {
  constexpr double level = 1e-6;  // rad
  return std::abs(angle) <= level;
}

const HarmonicMotion& shaking_along(const Vessel& tray) {
  if (!tray.motion) refuse("tray.motion", "the tray stands still");
  if (!std::holds_alternative<HarmonicMotion>(*tray.motion)) refuse("tray.motion.kind", "is not harmonic");
  const HarmonicMotion* motion = shaking(tray);
  if (motion == nullptr) refuse("tray.motion.amplitude", "the tray stands still");
  if (!is_level(motion->direction) || !is_level(motion->across))
    refuse("tray.motion.direction", "the tray is not shaken along its floor");
  if (motion->stop != never) refuse("tray.motion.stop", "the motion ends");
  return *motion;
}

bool all_round(const std::vector<Hole>& holes) {
  return std::ranges::all_of(holes, [](const Hole& hole) { return hole.shape == HoleShape::round; });
}

void check_holes(const std::vector<Hole>& holes) {
  if (holes.empty()) refuse("tray.holes", "there are none");
  if (!all_round(holes)) refuse("tray.holes.shape", "holes are not round");
  for (const Hole& hole : holes) {
    if (hole.width != holes.front().width) refuse("tray.holes.width", "holes are unequal");
    if (hole.open_at > 0) refuse("tray.holes.open_at", "a gate closes a hole");
    if (hole.chamfer > 0) refuse("tray.holes.chamfer", "a hole is chamfered");
  }
}

double peak_speed(const HarmonicMotion& motion, const PlannedSeed& seed) {
  return 2 * std::numbers::pi * motion.frequency * motion.amplitude / std::sqrt(standard_gravity * seed.diameter);
}

/// Over the seed's diameter.
double bed_depth(const Vessel& tray, const PlannedSeed& seed) {
  const double d = seed.diameter;
  const double depth = tray.fill->count * std::numbers::pi / 6 * d * d / (poured_packing * floor_area(tray));
  return std::round(depth / told_depth) * told_depth;
}

HoleConditions nearest_place(HoleConditions at, const HoleTable& table) {
  at.aspect = table.aspects().nearest(at.aspect);
  at.width = table.widths(at.aspect).nearest(at.width);
  at.peak_speed = table.peak_speeds(at.aspect).nearest(at.peak_speed);
  at.depth = table.depths(at.aspect).nearest(at.depth);
  return at;
}

/// Why none of a tray's holes is a place of the table, whatever its width and speed; empty where it may be.
std::string unlike_table(const Scene& scene, const HarmonicMotion& motion) {
  if (scene.lots.size() > 1) return "seeds: there are several lots, which count as seeds of their mean volume";
  if (!is_level(motion.direction)) return "tray.motion.direction: the tray is not shaken along its floor";
  return "";
}

}  // namespace

TableTray table_tray(const Scene& scene) {
  const Vessel& tray = scene.tray;
  if (scene.space == Space::two_dimensional) refuse("space", "the tray is in 2D");
  if (scene.hopper) refuse("hopper", "a hopper feeds the tray");
  if (tray.rain || !tray.fill) refuse("tray.fill", "the bed is not a fill");
  if (tray.tilt != 0 || tray.funnel != 0) refuse("tray.tilt", "the floor slopes");
  if (!tray.pieces.empty() || !tray.box) refuse("tray.pieces", "the tray is drawn");
  if (tray.plan != Plan::rectangle) refuse("tray.plan", "the tray is round");
  if (tray.sides == Sides::open || tray.front_and_back == Sides::open) refuse("tray.sides", "a side is open");
  check_holes(tray.holes);
  const HarmonicMotion& motion = shaking_along(tray);
  TableTray found;
  found.seed = planned_seed(scene.lots);
  found.holes = static_cast<int>(tray.holes.size());
  found.amplitude = motion.amplitude;
  found.frequency = motion.frequency;
  found.at = {found.seed.aspect, tray.holes.front().width / found.seed.diameter, peak_speed(motion, found.seed),
              bed_depth(tray, found.seed)};
  return found;
}

TableTray table_tray(const SowingTask& task, const PlannedLayout& layout) {
  return {task.seed,
          {task.seed.aspect, layout.width_over_d, layout.peak_speed, layout.depth_over_d},
          layout.feed.holes,
          layout.amplitude,
          layout.frequency};
}

std::string outside_table(const char* key, double value, const Span& known, const char* unit) {
  if (known.holds(value)) return "";
  return fmt::format("{}: {:.3g} {} is outside the table of one hole, which has {:.3g} to {:.3g}", key, value, unit,
                     known.least, known.most);
}

std::string outside_table(const HoleConditions& at, const HoleTable& table) {
  const Span aspects = table.aspects();
  std::string text = outside_table("seeds", at.aspect, aspects, "times as long as wide");
  const double aspect = aspects.nearest(at.aspect);
  const auto look = [&](const char* key, double value, const Span& known, const char* unit) {
    if (text.empty()) text = outside_table(key, value, known, unit);
  };
  look("tray.holes.width", at.width, table.widths(aspect), "seeds");
  look("tray.motion.frequency", at.peak_speed, table.peak_speeds(aspect), "sqrt(g d)");
  look("tray.fill.count", at.depth, table.depths(aspect), "seeds of depth");
  return text;
}

TrayTolerance tray_tolerance(const Scene& scene, const HoleTable& table, const BuildTolerance& tolerance) {
  const Vessel& tray = scene.tray;
  const HarmonicMotion* motion = shaking(tray);
  if (tray.holes.empty() || !all_round(tray.holes)) return {std::nullopt, "tray.holes.shape: holes are not round"};
  if (motion == nullptr) return {std::nullopt, "tray.motion: the tray is not shaken to and fro"};
  const PlannedSeed seed = planned_seed(scene.lots);
  std::string outside = unlike_table(scene, *motion);
  double sum = 0, by_width = 0, by_speed = 0;
  for (const Hole& hole : tray.holes) {
    HoleConditions own{seed.aspect, hole.width / seed.diameter, peak_speed(*motion, seed), 0};
    const Span depths = table.depths(table.aspects().nearest(own.aspect));
    own.depth = tray.fill ? depths.nearest(bed_depth(tray, seed)) : depths.most;
    if (outside.empty()) outside = outside_table(own, table);
    const HoleConditions at = nearest_place(own, table);
    const HoleTable::Slopes slopes = table.slopes(at);
    const double outflow = table.at(at).value().outflow;
    sum += outflow, by_width += outflow * slopes.width / hole.width, by_speed += outflow * slopes.peak_speed;
  }
  return {tolerance_deviation({by_width / sum, by_speed / sum}, tolerance), outside};
}

}  // namespace vibrosow
