#include "plan/geometry_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "grains/free_room.hpp"
#include "grains/turned_discs.hpp"
#include "plan/vessels_that_meet.hpp"
#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "scene/plane_alone.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/bounding_box.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

using Warnings = std::vector<std::string>;

std::string in_mm(double length) {
  return fmt::format("{:.3g} mm", length * 1e3);
}

std::string name_of_piece(const Vessel& vessel, std::size_t k) {
  return fmt::format("{}.pieces: piece {}", vessel.name, k + 1);
}

// Pieces over holes.

/// m.
struct Stretch {
  double from, to;
};

/// How far above and below the floor's line (m) what is drawn lets no seed through a hole. A line steeper than 45
/// degrees narrows it, as a chute does, and counts below as above.
struct Near {
  double above, below;
};

/// The part of a straight line that is so near the floor's line, as parts of the line.
std::optional<Stretch> near_floor(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Near near) {
  const double rise = b.y() - a.y();
  if (rise == 0) return a.y() < near.above && a.y() > -near.below ? std::optional(Stretch{0, 1}) : std::nullopt;
  const double below = std::abs(rise) > std::abs(b.x() - a.x()) ? near.above : near.below;
  const double one = (-below - a.y()) / rise, other = (near.above - a.y()) / rise;
  const Stretch part{std::max(0.0, std::min(one, other)), std::min(1.0, std::max(one, other))};
  return part.from < part.to ? std::optional(part) : std::nullopt;
}

/// Over which stretches of the floor, along it or across, a piece that is drawn out lies near it.
std::vector<Stretch> over_floor(const WallPiece& piece, Near near) {
  WallSegment wall{piece.a, piece.b, ""};
  wall.centre = piece.centre, wall.radius = piece.radius, wall.from = piece.from, wall.to = piece.to;
  const std::vector<Eigen::Vector2d> points = wall_points(wall);
  std::vector<Stretch> stretches;
  for (std::size_t k = 1; k < points.size(); ++k)
    if (const auto part = near_floor(points[k - 1], points[k], near)) {
      const double along = points[k].x() - points[k - 1].x();
      const double one = points[k - 1].x() + part->from * along, other = points[k - 1].x() + part->to * along;
      stretches.push_back({std::min(one, other), std::max(one, other)});
    }
  return stretches;
}

/// How much of a hole a piece covers, as a part of it; 0: it stands in it; nothing: neither.
using Covered = std::optional<double>;

constexpr double rim = 0.02;  // of a hole's width, or its length across: what reaches no further in is beside it

Covered covered_by_drawn_out(const WallPiece& piece, const Hole& hole, Near near) {
  const bool along = piece.drawn_out == DrawnOut::along;
  const double middle = along ? hole.across : hole.centre;
  const double width = along && hole.shape == HoleShape::slot ? hole.across_length : hole.width;
  const double left = middle - width / 2, right = middle + width / 2, slack = rim * width;
  std::vector<Stretch> over = over_floor(piece, near);
  std::ranges::sort(over, {}, &Stretch::from);
  Covered covered;
  double reached = left;
  for (const Stretch& one : over) {
    if (one.to < left + slack || one.from > right - slack) continue;
    const double from = std::max(one.from, reached), to = std::min(one.to, right);
    covered = covered.value_or(0) + std::max(0.0, to - from) / width;
    reached = std::max(reached, to);
  }
  return covered;
}

/// Whether a piece turned about an axis lies near the floor at a place of it (m).
bool is_over(const WallPiece& piece, double x, double z, Near near) {
  if (piece.axis == PieceAxis::upright) {
    const auto part = near_floor(piece.a, piece.b, near);
    const double away = portable_math::hypot(x - piece.about->x(), z - piece.about->y());
    const double one = piece.a.x() + (part ? part->from : 0) * (piece.b.x() - piece.a.x());
    const double other = piece.a.x() + (part ? part->to : 0) * (piece.b.x() - piece.a.x());
    return part && away >= std::min(one, other) && away <= std::max(one, other);
  }
  const double along = piece.b.y() - piece.a.y(), part = along == 0 ? 0 : (x - piece.a.y()) / along;
  if (along == 0 || part < 0 || part > 1) return false;
  const double radius = piece.a.x() + part * (piece.b.x() - piece.a.x()), aside = z - piece.about->y();
  if (std::abs(aside) > radius) return false;
  const double up = std::sqrt(radius * radius - aside * aside);
  const auto is_near = [near](double y) { return y < near.above && y > -near.below; };
  return is_near(piece.about->x() + up) || is_near(piece.about->x() - up);
}

/// Places of a hole are looked at on a grid; a thin wall that stands in the hole passes between them and is not seen.
Covered covered_by_turned(const WallPiece& piece, const Hole& hole, Near near) {
  constexpr int rows = 25;
  const bool round = hole.shape == HoleShape::round;
  const double half_z = 0.5 * (round ? hole.width : hole.across_length);
  int places = 0, under = 0;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < rows; ++k) {
      const double u = (2 * i + 1.0) / rows - 1, v = (2 * k + 1.0) / rows - 1;
      if (round && u * u + v * v > 1) continue;
      ++places;
      under += is_over(piece, hole.centre + u * hole.width / 2, hole.across + v * half_z, near) ? 1 : 0;
    }
  return under == 0 ? std::nullopt : Covered(static_cast<double>(under) / places);
}

/// The holes that are covered, if only in part.
std::vector<bool> warn_of_covered_holes(const Scene& scene, const Vessel& vessel, Warnings& warnings) {
  std::vector<bool> all_covered(vessel.holes.size(), false);
  double seed = std::numeric_limits<double>::infinity();
  for (const SeedLot& lot : scene.lots) seed = std::min(seed, mean_thickness(lot));
  for (std::size_t k = 0; k < vessel.pieces.size(); ++k) {
    const WallPiece& piece = vessel.pieces[k];
    std::string holes;
    for (std::size_t h = 0; h < vessel.holes.size(); ++h) {
      const Hole& hole = vessel.holes[h];
      // Nothing comes from aside between the floor and what lies half a seed over it, and nothing leaves between what
      // lies a seed under the hole and the hole.
      const Near near{0.5 * seed, hole.thickness + seed};
      const Covered covered =
          !plane_alone && piece.about ? covered_by_turned(piece, hole, near) : covered_by_drawn_out(piece, hole, near);
      if (!covered) continue;
      all_covered[h] = true;
      holes += fmt::format("{}hole {}", holes.empty() ? "" : ", ", h + 1);
      if (*covered < 0.995)
        holes += *covered < 0.005 ? " (stands in it)" : fmt::format(" ({:.0f} % of it)", 100 * *covered);
    }
    if (!holes.empty())
      warnings.push_back(
          fmt::format("{} covers {}: what is drawn across a hole is a wall there", name_of_piece(vessel, k), holes));
  }
  return all_covered;
}

/// Whether a seed can come to the middle of a hole from the vessel's open top, or to a place beside it.
bool is_come_to(const Hole& hole, const FreeRoom& room, double half_width) {
  const double aside = 0.25 * (hole.shape == HoleShape::round ? hole.width : hole.across_length);
  for (const double x : {0.0, -0.25 * hole.width, 0.25 * hole.width})
    for (const double z : {0.0, -aside, aside})
      if (room.holds({hole.centre + x, half_width, hole.across + z})) return true;
  return false;
}

/// A groove or a slope shuts off the holes beneath it.
void warn_of_holes_shut_off(const Scene& scene, const Vessel& vessel, const std::vector<bool>& covered,
                            Warnings& warnings) {
  if (vessel.pieces.empty() || vessel.holes.empty()) return;
  constexpr double few_cells = 1e6;  // a hole that lies open above needs none
  const double half_width = least_half_width(scene.lots);
  const FreeRoom quick(vessel, scene.space, half_width, few_cells);
  // Where few cells miss narrow ways, as many are taken as where seeds are put in.
  std::optional<FreeRoom> fine;
  const auto is_shut_off = [&](const Hole& hole) {
    if (is_come_to(hole, quick, half_width)) return false;
    if (!quick.missed_width()) return true;
    if (!fine) fine.emplace(vessel, scene.space, half_width);
    return !is_come_to(hole, *fine, half_width);
  };
  std::string holes;
  for (std::size_t h = 0; h < vessel.holes.size(); ++h)
    if (!covered[h] && vessel.holes[h].width >= 2 * half_width && is_shut_off(vessel.holes[h]))
      holes += fmt::format("{}hole {}", holes.empty() ? "" : ", ", h + 1);
  if (holes.empty()) return;
  const std::optional<double> missed = fine ? fine->missed_width() : std::nullopt;
  warnings.push_back(
      missed
          ? fmt::format("{}.pieces: shut off {}, or leave ways narrower than {}: such are not looked for among pieces "
                        "so large for their seeds",
                        vessel.name, holes, in_mm(*missed))
          : fmt::format("{}.pieces: shut off {}: no seed comes there from above", vessel.name, holes));
}

// Outlets beside the tray.

/// How far (m) places of a hopper's floor reach along and across the tray, in the tray's frame, where what leaves them
/// comes to the tray's mouth: straight down to the height of its end walls, without these to its floor.
BoundingBox fallen_to_tray(const Scene& scene, const std::vector<Eigen::Vector3d>& places) {
  const Vessel &tray = scene.tray, &hopper = *scene.hopper;
  const Pose of_tray = vessel_pose(tray, 0), of_hopper = vessel_pose(hopper, 0);
  const double mouth = tray.sides == Sides::walls ? tray.height : 0;
  BoundingBox box;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d lab = point_in_lab(hopper, of_hopper, place);
    Eigen::Vector3d own = point_in_vessel(tray, of_tray, lab);
    const Eigen::Vector3d down = point_in_vessel(tray, of_tray, lab - Eigen::Vector3d::UnitY()) - own;
    if (own.y() > mouth && down.y() < 0) own += (mouth - own.y()) / down.y() * down;
    box.include(own);
  }
  return box;
}

/// What a hopper lets out beside the tray is spilled.
void warn_of_outlets_beside_tray(const Scene& scene, Warnings& warnings) {
  const Vessel& tray = scene.tray;
  if (!scene.hopper || !tray.box || turns_steadily(tray)) return;
  const bool is_3d = !plane_alone && scene.space != Space::two_dimensional;
  for (std::size_t k = 0; k < scene.hopper->holes.size(); ++k) {
    const Hole& hole = scene.hopper->holes[k];
    const double slack = rim * hole.width, half = 0.5 * hole.width;
    const double half_across = hole.shape == HoleShape::round ? half : 0.5 * hole.across_length;
    const auto warn = [&](double from, double to, const std::string& of_tray) {
      warnings.push_back(fmt::format("hopper.holes: hole {} is over {} to {} {}: what falls beside the tray is spilled",
                                     k + 1, in_mm(from), in_mm(to), of_tray));
    };
    const Eigen::Vector3d middle(hole.centre, 0, is_3d ? hole.across : 0), along(half, 0, 0);
    const BoundingBox over = fallen_to_tray(scene, {middle - along, middle + along});
    if (tray.sides != Sides::periodic && (over.low.x() < -slack || over.high.x() > tray.length + slack))
      warn(over.low.x(), over.high.x(), fmt::format("of the tray, which is {} long", in_mm(tray.length)));
    if (!is_3d || tray.front_and_back == Sides::periodic) continue;
    const Eigen::Vector3d across(0, 0, half_across);
    const BoundingBox beside = fallen_to_tray(scene, {middle - across, middle + across});
    if (beside.low.z() < -slack || beside.high.z() > *tray.depth + slack)
      warn(beside.low.z(), beside.high.z(), fmt::format("from the tray's front, which is {} deep", in_mm(*tray.depth)));
  }
}

// Where pieces reach to.

void warn_of_large_pieces(const Vessel& vessel, Warnings& warnings) {
  constexpr double most = 3;
  if (vessel.pieces.empty()) return;
  const double size = extent(vessel.pieces).size(), of_vessel = std::max(vessel.length, vessel.height);
  if (size > most * of_vessel)
    warnings.push_back(fmt::format("{}.pieces: reach over {}, the {} is {} long and {} high: are their units right?",
                                   vessel.name, in_mm(size), vessel.name, in_mm(vessel.length), in_mm(vessel.height)));
}

/// The counting line is the tray's.
void warn_of_pieces_below(const Scene& scene, const Vessel& vessel, Warnings& warnings) {
  if (turns_steadily(scene.tray)) return;
  const Pose of_tray = vessel_pose(scene.tray, 0), pose = vessel_pose(vessel, 0);
  for (std::size_t k = 0; k < vessel.pieces.size(); ++k) {
    const WallPiece& piece = vessel.pieces[k];
    const Extent all = extent({piece});
    double lowest = std::numeric_limits<double>::infinity();
    const auto include = [&](const Eigen::Vector2d& own) {
      lowest = std::min(lowest, in_vessel_frame(scene.tray, of_tray, in_lab_frame(vessel, pose, own)).y());
    };
    if (piece.drawn_out == DrawnOut::along)
      include({0, all.low.y()}), include({vessel.length, all.low.y()});
    else if (!piece.about && piece.radius == 0)
      include(piece.a), include(piece.b);
    else
      for (const double x : {all.low.x(), all.high.x()}) include({x, all.low.y()}), include({x, all.high.y()});
    if (!(lowest < -scene.run.count_below)) continue;
    warnings.push_back(
        fmt::format("{} reaches {} below the tray's floor, and seeds are counted {} below it (run.count_below): what "
                    "it does to them "
                    "further down counts for nothing",
                    name_of_piece(vessel, k), in_mm(-lowest), in_mm(scene.run.count_below)));
    return;  // one of a drawing says enough
  }
}

}  // namespace

std::vector<std::string> geometry_warnings(const Scene& scene) {
  Warnings warnings;
  std::vector<const Vessel*> vessels = {&scene.tray};
  if (scene.hopper) vessels.push_back(&*scene.hopper);
  for (const Vessel* vessel : vessels) {
    const std::vector<bool> covered = warn_of_covered_holes(scene, *vessel, warnings);
    warn_of_holes_shut_off(scene, *vessel, covered, warnings);
    warn_of_large_pieces(*vessel, warnings);
    warn_of_pieces_below(scene, *vessel, warnings);
  }
  if (const std::optional<VesselsMeet> met = first_meeting_of_vessels(scene))
    warnings.push_back(fmt::format("hopper: passes through the tray, at {:.3g} s {} do", met->time, met->walls));
  warn_of_outlets_beside_tray(scene, warnings);
  return warnings;
}

}  // namespace vibrosow
