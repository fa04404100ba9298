// What check warns of and a run doubts, on drawn scenes: what changes while rates are measured, plates at holes,
// outlets beside the tray, seeds that fall there, trays that drain. Each has its word, and nothing else has.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "outflow/outflow.hpp"
#include "plan/scene_warnings.hpp"
#include "scene/measuring_window.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "scenes/any_scene.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + word;
  return text.empty() ? " nothing" : text;
}

// ---- what changes in the window ----

bool stands(const PoseRate& rate) {
  return rate.velocity.norm() + std::abs(rate.angular_velocity) + std::abs(rate.across_velocity) +
             std::abs(rate.turn_rate) ==
         0;
}

/// The motion as if it had always been and never ended.
VesselMotion for_ever(VesselMotion motion) {
  const auto go_on = [](auto& one) { one.ramp = 0, one.stop = never, one.stop_ramp = 0; };
  std::visit(
      [&](auto& one) {
        using Motion = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<Motion, SumMotion>)
          for (HarmonicMotion& component : one.components) go_on(component);
        else if constexpr (!std::is_same_v<Motion, TableMotion>)
          go_on(one);
      },
      motion);
  return motion;
}

/// How two rates differ. A vessel that turned up slowly lags behind one that always turned, and is as fast.
double apart(const PoseRate& a, const PoseRate& b, bool turns) {
  const auto speed = [](const PoseRate& rate) { return std::hypot(rate.velocity.norm(), rate.across_velocity); };
  const double velocity = turns ? std::abs(speed(a) - speed(b))
                                : (a.velocity - b.velocity).norm() + std::abs(a.across_velocity - b.across_velocity);
  return velocity + std::abs(a.angular_velocity - b.angular_velocity) + std::abs(a.turn_rate - b.turn_rate);
}

/// Whether all through the window the vessel goes on as ever, or stands.
bool moves_evenly(const Vessel& vessel, const MeasuringWindow& window) {
  if (!vessel.motion) return true;
  if (const auto* table = std::get_if<TableMotion>(&*vessel.motion))
    return table->times.front() <= window.from && table->times.back() >= window.to;
  Vessel even = vessel;
  even.motion = for_ever(*vessel.motion);
  const VesselPath path(vessel), steady(even);
  const bool turns = std::holds_alternative<TurningMotion>(*vessel.motion);
  bool as_ever = true, still = true;
  constexpr int looks = 97;
  for (int k = 1; k < looks; ++k) {
    const double time = window.from + window.length() * k / looks;
    const PoseRate rate = path.rate(time);
    as_ever &= apart(rate, steady.rate(time), turns) < 1e-9, still &= stands(rate);
  }
  return as_ever || still;
}

/// Keys of what begins or ends within the window; of a motion "tray.motion".
std::set<std::string> changing(const Scene& scene, const MeasuringWindow& window) {
  std::set<std::string> keys;
  constexpr double rounding = 1e-9;  // s
  const auto is_within = [&](double time) { return time > window.from + rounding && time < window.to - rounding; };
  for (const Vessel& vessel : vessels_of(scene)) {
    if (!moves_evenly(vessel, window)) keys.insert(vessel.name + ".motion");
    for (const Hole& hole : vessel.holes)
      if (hole.open_at > window.from + rounding) keys.insert(vessel.name + ".holes.open_at");
    if (vessel.rain && vessel.rain->start > window.from + rounding) keys.insert(vessel.name + ".rain.start");
    if (vessel.rain && is_within(vessel.rain->stop)) keys.insert(vessel.name + ".rain.stop");
  }
  return keys;
}

std::string not_warned_of_changes(const Scene& scene, const std::vector<std::string>& warnings) {
  const MeasuringWindow window = measuring_window(scene);
  std::set<std::string> warned, expected;
  for (const std::string& warning : warnings) {
    if (warning.find(", and rates are measured from ") == std::string::npos) continue;
    const std::string key = warning.substr(0, warning.find(": ")), vessel = key.substr(0, key.find('.'));
    warned.insert(key.starts_with(vessel + ".motion.") ? vessel + ".motion" : key);
  }
  if (!window.empty() && !scene.tray.holes.empty()) expected = changing(scene, window);
  return warned == expected ? "" : "warned of" + joined(warned) + ", not of" + joined(expected);
}

// ---- plates at holes ----

/// How a hole's number stands in the warning of a piece that covers holes, " (NN % of it)" behind it; empty: not at
/// all.
std::string covered_by(const std::vector<std::string>& warnings, const Vessel& vessel, std::size_t piece,
                       std::size_t hole) {
  const std::string begin = vessel.name + ".pieces: piece " + std::to_string(piece + 1) + " covers ";
  const std::string name = "hole " + std::to_string(hole + 1);
  for (const std::string& warning : warnings) {
    if (!warning.starts_with(begin)) continue;
    const std::string holes = warning.substr(begin.size(), warning.rfind(": ") - begin.size());
    const auto at = holes.find(name);
    if (at != std::string::npos) return holes.substr(at, holes.find(',', at) - at);
  }
  return "";
}

double thinnest(const std::vector<SeedLot>& lots) {
  double thin = std::numeric_limits<double>::infinity();
  for (const SeedLot& lot : lots) thin = std::min(thin, mean_thickness(lot));
  return thin;
}

std::string plate_not_warned_of(const Scene& scene, const std::vector<std::string>& warnings) {
  const double thin = thinnest(scene.lots), slack = 1e-9;
  for (const Vessel& vessel : vessels_of(scene))
    for (std::size_t k = 0; k < vessel.pieces.size(); ++k) {
      const WallPiece& piece = vessel.pieces[k];
      const bool level =
          piece.radius == 0 && !piece.about && piece.drawn_out == DrawnOut::across && piece.a.y() == piece.b.y();
      for (std::size_t h = 0; level && h < vessel.holes.size(); ++h) {
        const Hole& hole = vessel.holes[h];
        const double left = hole.centre - hole.width / 2, right = hole.centre + hole.width / 2, y = piece.a.y();
        double over = -1;
        for (const double shift : {0.0, -vessel.length, vessel.length}) {
          if (shift != 0 && vessel.sides != Sides::periodic) continue;
          const double from = std::max(left, std::min(piece.a.x(), piece.b.x()) + shift);
          const double to = std::min(right, std::max(piece.a.x(), piece.b.x()) + shift);
          over = std::max(over, to - from);
        }
        // No seed comes between the floor and what is half a seed over it, or between a hole and what is a seed below.
        const bool shuts = y < 0.5 * thin - slack && y > -hole.thickness - thin + slack;
        const std::string covered = covered_by(warnings, vessel, k, h);
        const std::string what = vessel.name + " piece " + std::to_string(k + 1) + " at hole " + std::to_string(h + 1);
        if ((!shuts || over < 0) && !covered.empty()) return "warned of in vain: " + what;
        if (shuts && over > 0.1 * hole.width && covered.empty()) return "not warned of: " + what;
        const bool whole = over > 0.999 * hole.width;
        if (shuts && whole && covered.find('%') != std::string::npos) return "said to cover a part: " + what;
      }
    }
  return "";
}

// ---- outlets beside the tray ----

/// How far (m) beside the tray's mouth a place of the hopper's floor lets its seeds fall: they fall straight down to
/// where the end walls begin, or where there are none to the floor.
double beside_tray(const Scene& scene, const Eigen::Vector3d& of_hopper) {
  const Vessel& tray = scene.tray;
  const Pose of_tray = vessel_pose(tray, 0), pose = vessel_pose(*scene.hopper, 0);
  const auto in_tray = [&](const Eigen::Vector3d& lab) { return point_in_vessel(tray, of_tray, lab); };
  Eigen::Vector3d lab = point_in_lab(*scene.hopper, pose, of_hopper);
  const double mouth = tray.sides == Sides::walls ? tray.height : 0;
  for (int k = 0; k < 60 && in_tray(lab).y() > mouth; ++k) lab.y() -= in_tray(lab).y() - mouth;  // nears it
  const Eigen::Vector3d own = in_tray(lab);
  const bool deep = scene.space != Space::two_dimensional;
  double beside = tray.sides == Sides::periodic ? -1 : std::max(-own.x(), own.x() - tray.length);
  if (deep && tray.front_and_back != Sides::periodic) beside = std::max({beside, -own.z(), own.z() - *tray.depth});
  return beside;
}

/// The furthest of its rim, m.
double beside_tray(const Scene& scene, const Hole& hole) {
  const bool round = hole.shape == HoleShape::round;
  double beside = -1;
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * std::numbers::pi * k / 64, x = std::cos(angle), z = std::sin(angle);
    const double corner = round ? 1 : 1 / std::max(std::abs(x), std::abs(z));
    const double across = 0.5 * corner * z * (round ? hole.width : hole.across_length);
    beside = std::max(
        beside, beside_tray(scene, Eigen::Vector3d(hole.centre + 0.5 * corner * x * hole.width, 0,
                                                   scene.space == Space::two_dimensional ? 0 : hole.across + across)));
  }
  return beside;
}

std::string outlet_not_warned_of(const Scene& scene, const std::vector<std::string>& warnings) {
  if (!scene.hopper || !scene.tray.box || turns_steadily(scene.tray)) return "";
  for (std::size_t k = 0; k < scene.hopper->holes.size(); ++k) {
    const Hole& hole = scene.hopper->holes[k];
    const std::string begin = "hopper.holes: hole " + std::to_string(k + 1) + " is over ";
    const bool warned =
        std::ranges::any_of(warnings, [&](const std::string& warning) { return warning.starts_with(begin); });
    const double beside = beside_tray(scene, hole);
    if (warned && beside < 1e-9) return "an outlet over the tray is said to be beside it";
    if (!warned && beside > 0.05 * hole.width)
      return "not warned of: an outlet " + std::to_string(beside) + " m beside the tray";
  }
  return "";
}

// ---- all of them ----

std::string warned_wrongly(const DrawnScene& drawn) {
  const std::optional<Scene> scene = scene_of(drawn);
  if (!scene) return "";
  const std::vector<std::string> warnings = scene_warnings(*scene);
  for (const auto wrong : {not_warned_of_changes, plate_not_warned_of, outlet_not_warned_of})
    if (const std::string text = wrong(*scene, warnings); !text.empty()) return text;
  return "";
}

// ---- what a run doubts ----

bool has(const std::vector<Doubt>& doubts, DoubtKind kind) {
  return std::ranges::find(doubts, kind, &Doubt::kind) != doubts.end();
}

std::string spilling_not_doubted(const vibrosow::Run& result, const Outflow& outflow) {
  std::int64_t counted = 0, spilled = 0;
  for (const OutflowEvent& event : result.events) ++(event.hole > 0 ? counted : spilled);
  const bool much = spilled > 5 && 20 * spilled > counted + spilled;
  const std::string told = std::to_string(spilled) + " of " + std::to_string(counted + spilled) + " seeds that left";
  if (has(outflow.doubts, DoubtKind::seeds_spilled) != much)
    return told + (much ? " were spilled, and nothing is said" : " were spilled, and that is said");
  const double share = static_cast<double>(spilled) / static_cast<double>(counted + spilled);
  return counted + spilled == 0 || outflow.spilled_fraction == share ? "" : told + " are told as another share";
}

/// `before`: seeds in the tray when the window began, by a look or so.
std::string draining_not_doubted(const vibrosow::Run& result, const Outflow& outflow, std::int64_t before) {
  const double held = static_cast<double>(before), left = static_cast<double>(result.tray_at_end);
  const double least = std::min(0.5 * held, held - 3 * std::sqrt(held));
  if (has(outflow.doubts, DoubtKind::ran_dry) || std::abs(left - least) < 2) return "";
  if (has(outflow.doubts, DoubtKind::drained) == (left < least)) return "";
  return std::to_string(before) + " seeds lay in the tray when the window began and " +
         std::to_string(result.tray_at_end) + " at its end, and it is " +
         (left < least ? "not called drained" : "called drained");
}

std::string not_doubted(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start || start->model.scene.tray.holes.empty()) return "";
  const Scene scene = start->model.scene;
  const MeasuringWindow window = measuring_window(scene);
  Simulation run(start->model, std::move(start->state));
  run.run_until(window.from);
  const std::int64_t before = run.result().tray_at_end;
  run.run_until(scene.run.duration);
  const vibrosow::Run result = run.result();
  const Outflow outflow = measure_outflow(scene, result);
  if (result.status != RunStatus::finished || result.outside_the_model || window.empty()) return "";
  const std::string text = spilling_not_doubted(result, outflow);
  return text.empty() ? draining_not_doubted(result, outflow, before) : text;
}

TEST(DrawnScene, IsWarnedOfWhatCanHardlyBeMeant) {
  expect_of_drawn_scenes(100, warned_wrongly);
}

TEST(DrawnScene, IsDoubtedWhereItSpillsOrDrains) {
  expect_of_drawn_scenes(30, not_doubted);
}

}  // namespace
}  // namespace vibrosow
