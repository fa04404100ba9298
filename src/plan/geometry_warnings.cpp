#include "plan/geometry_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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
#include "vessel/hopper_images.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"
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

/// Of a piece that is not turned, see `wall_points`.
std::vector<Eigen::Vector2d> points_of(const WallPiece& piece) {
  WallSegment wall{piece.a, piece.b, ""};
  wall.centre = piece.centre, wall.radius = piece.radius, wall.from = piece.from, wall.to = piece.to;
  return wall_points(wall);
}

/// Over which stretches of the floor, along it or across, a piece that is drawn out lies near it.
std::vector<Stretch> over_floor(const WallPiece& piece, Near near) {
  const std::vector<Eigen::Vector2d> points = points_of(piece);
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

/// A piece each time that it stands beside a hole, in the frame of the hole's vessel.
using Copies = std::vector<WallPiece>;

Covered covered_by_drawn_out(const Copies& copies, const Hole& hole, Near near) {
  const bool along = !plane_alone && copies.front().drawn_out == DrawnOut::along;
  const double middle = along ? hole.across : hole.centre;
  const double width = along && hole.shape == HoleShape::slot ? hole.across_length : hole.width;
  const double left = middle - width / 2, right = middle + width / 2, slack = rim * width;
  std::vector<Stretch> over;
  for (const WallPiece& piece : copies) std::ranges::copy(over_floor(piece, near), std::back_inserter(over));
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

/// How far (m) from its upright axis a piece lies near the floor.
std::optional<Stretch> radii_near_floor(const WallPiece& piece, Near near) {
  const auto part = near_floor(piece.a, piece.b, near);
  if (!part) return std::nullopt;
  const double outwards = piece.b.x() - piece.a.x();
  const double one = piece.a.x() + part->from * outwards, other = piece.a.x() + part->to * outwards;
  return Stretch{std::min(one, other), std::max(one, other)};
}

/// How far (m) to either side of its axis along the vessel a piece lies near the floor, anywhere in a stretch of that.
std::optional<Stretch> aside_near_floor(const WallPiece& piece, const Stretch& x, Near near) {
  const double left = std::max(x.from, std::min(piece.a.y(), piece.b.y()));
  const double right = std::min(x.to, std::max(piece.a.y(), piece.b.y()));
  if (left > right) return std::nullopt;
  const double along = piece.b.y() - piece.a.y(), outwards = piece.b.x() - piece.a.x();
  const auto radius_at = [&](double at) { return piece.a.x() + (at - piece.a.y()) / along * outwards; };
  const double one = along == 0 ? piece.a.x() : radius_at(left), other = along == 0 ? piece.b.x() : radius_at(right);
  const double low = -near.below - piece.about->x(), high = near.above - piece.about->x();
  const double nearest = std::max({0.0, low, -high}), furthest = std::max(std::abs(low), std::abs(high));
  const double least = std::min(one, other), most = std::max(one, other);
  if (most <= nearest) return std::nullopt;
  return Stretch{std::sqrt(std::max(0.0, least * least - furthest * furthest)),
                 std::sqrt(most * most - nearest * nearest)};
}

/// Whether a piece turned about an axis lies near the floor at a place of it (m).
bool is_over(const WallPiece& piece, double x, double z, Near near) {
  const bool upright = piece.axis == PieceAxis::upright;
  const std::optional<Stretch> reach = upright ? radii_near_floor(piece, near) : aside_near_floor(piece, {x, x}, near);
  const double away =
      upright ? portable_math::hypot(x - piece.about->x(), z - piece.about->y()) : std::abs(z - piece.about->y());
  return reach && away >= reach->from && away <= reach->to;
}

/// How far (m) the places within `half` of a middle are from zero.
Stretch distances(double middle, double half) {
  return {std::max(0.0, std::abs(middle) - half), std::abs(middle) + half};
}

constexpr int rows = 25;  // of places in a hole, along it and across

/// Half of a hole's length across (m) in a row of places, told from -1 to 1.
double half_across(const Hole& hole, double row) {
  return hole.shape == HoleShape::slot ? 0.5 * hole.across_length : 0.5 * hole.width * std::sqrt(1 - row * row);
}

/// Whether a piece turned about an axis lies near the floor anywhere in a hole, however thin it is.
bool stands_in(const WallPiece& piece, Hole hole, Near near) {
  hole.width *= 1 - 2 * rim, hole.across_length *= 1 - 2 * rim;
  const auto overlap = [](const std::optional<Stretch>& one, const Stretch& other) {
    return one && one->from < other.to && one->to > other.from;
  };
  const double half = 0.5 * hole.width;
  if (piece.axis == PieceAxis::upright) {
    const double aside = hole.centre - piece.about->x(), across = hole.across - piece.about->y();
    Stretch away = distances(portable_math::hypot(aside, across), half);
    if (hole.shape == HoleShape::slot) {
      const Stretch x = distances(aside, half), z = distances(across, 0.5 * hole.across_length);
      away = {portable_math::hypot(x.from, z.from), portable_math::hypot(x.to, z.to)};
    }
    return overlap(radii_near_floor(piece, near), away);
  }
  for (int i = 0; i < rows; ++i) {
    const double row = (2 * i + 1.0) / rows - 1, x = hole.centre + row * half;
    const Stretch z = distances(hole.across - piece.about->y(), half_across(hole, row));
    if (overlap(aside_near_floor(piece, {x - half / rows, x + half / rows}, near), z)) return true;
  }
  return false;
}

/// By the places of a grid; a thin wall that passes between them stands in the hole.
Covered covered_by_turned(const Copies& copies, const Hole& hole, Near near) {
  int places = 0, under = 0;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < rows; ++k) {
      const double u = (2 * i + 1.0) / rows - 1, v = (2 * k + 1.0) / rows - 1;
      const bool round = hole.shape == HoleShape::round;
      if (round && u * u + v * v > 1) continue;
      const double x = hole.centre + u * hole.width / 2;
      const double z = hole.across + v * 0.5 * (round ? hole.width : hole.across_length);
      ++places;
      under += std::ranges::any_of(copies, [&](const WallPiece& piece) { return is_over(piece, x, z, near); }) ? 1 : 0;
    }
  if (under > 0) return static_cast<double>(under) / places;
  const bool stands = std::ranges::any_of(copies, [&](const WallPiece& piece) { return stands_in(piece, hole, near); });
  return stands ? Covered(0) : std::nullopt;
}

/// `by`: m, along, up and across.
WallPiece shifted(WallPiece piece, const Eigen::Vector3d& by) {
  if (plane_alone || !piece.about) {
    const Eigen::Vector2d shift(piece.drawn_out == DrawnOut::along ? by.z() : by.x(), by.y());
    piece.a += shift, piece.b += shift, piece.centre += shift;
    return piece;
  }
  const bool upright = piece.axis == PieceAxis::upright;
  *piece.about += Eigen::Vector2d(upright ? by.x() : by.y(), by.z());
  const double along_axis = upright ? by.y() : by.x();
  piece.a.y() += along_axis, piece.b.y() += along_axis;
  return piece;
}

/// A vessel's piece, and where it is periodic those one period to either side.
Copies with_images(const Vessel& vessel, const WallPiece& piece) {
  Copies copies;
  const int most_x = vessel.sides == Sides::periodic ? 1 : 0;
  const int most_z = !plane_alone && vessel.front_and_back == Sides::periodic ? 1 : 0;
  for (int i = -most_x; i <= most_x; ++i)
    for (int k = -most_z; k <= most_z; ++k)
      copies.push_back(shifted(piece, {i * vessel.length, 0, k * vessel.depth.value_or(0)}));
  return copies;
}

/// Two vessels as they stand at the start.
struct SideBySide {
  const Vessel &own, &other;
  Pose of_own = vessel_pose(own, 0), of_other = vessel_pose(other, 0);

  /// Where a place of the one (m) is in the other.
  Eigen::Vector3d in_own(const Eigen::Vector3d& place) const {
    return point_in_vessel(own, of_own, point_in_lab(other, of_other, place));
  }
  Eigen::Vector3d in_other(const Eigen::Vector3d& place) const {
    return point_in_vessel(other, of_other, point_in_lab(own, of_own, place));
  }
};

/// Whether a piece of the other vessel that is drawn out in 3D reaches as far across, or along, as a hole.
bool reaches_to(const WallPiece& piece, const Hole& hole, const SideBySide& vessels) {
  const Vessel& other = vessels.other;
  const Eigen::Vector3d at = vessels.in_other({hole.centre, 0, hole.across});
  if (piece.about) return true;
  if (piece.drawn_out == DrawnOut::along)
    return other.sides == Sides::periodic || (at.x() > 0 && at.x() < other.length);
  return other.front_and_back == Sides::periodic || (at.z() > 0 && at.z() < *other.depth);
}

/// The copies of a piece of the other vessel in the frame of the hole's. Where that leans another way, only of pieces
/// of the plane, arcs as lines between points of theirs.
Copies seen_from_own(const WallPiece& piece, const SideBySide& vessels) {
  Copies copies;
  for (const WallPiece& one : with_images(vessels.other, piece)) {
    if (vessels.own.tilt == vessels.other.tilt) {
      copies.push_back(shifted(one, vessels.in_own(Eigen::Vector3d::Zero())));
    } else if (is_of_plane(one)) {
      const std::vector<Eigen::Vector2d> points = points_of(one);
      const auto in_own = [&](const Eigen::Vector2d& at) {
        return Eigen::Vector2d(vessels.in_own({at.x(), at.y(), 0}).head<2>());
      };
      for (std::size_t k = 1; k < points.size(); ++k)
        copies.push_back({.a = in_own(points[k - 1]), .b = in_own(points[k])});
    }
  }
  return copies;
}

/// Warns of pieces over a vessel's holes and notes these, if they are covered only in part.
class CoveredHoles {
 public:
  CoveredHoles(const Scene& scene, const Vessel& vessel)
      : vessel_(vessel), is_3d_(scene.space == Space::three_dimensional), covered_(vessel.holes.size(), false) {
    for (const SeedLot& lot : scene.lots) seed_ = std::min(seed_, mean_thickness(lot));
  }

  void warn_of_own(Warnings& warnings) {
    for (std::size_t k = 0; k < vessel_.pieces.size(); ++k) {
      const Copies copies = with_images(vessel_, vessel_.pieces[k]);
      const std::string holes = beside([&](const Hole&) -> const Copies& { return copies; });
      if (!holes.empty())
        warnings.push_back(
            fmt::format("{} covers {}: what is drawn across a hole is a wall there", name_of_piece(vessel_, k), holes));
    }
  }

  /// `others`: another vessel, and its images, which have as many pieces. Of what turns over and over nothing is said.
  void warn_of_pieces_of(const std::vector<Vessel>& others, Warnings& warnings) {
    if (turns_steadily(vessel_) || turns_steadily(others.front())) return;
    std::vector<SideBySide> stand;
    for (const Vessel& other : others) stand.push_back({vessel_, other});
    for (std::size_t k = 0; k < others.front().pieces.size(); ++k) {
      std::vector<Copies> of_each;
      for (const SideBySide& one : stand) of_each.push_back(seen_from_own(one.other.pieces[k], one));
      const std::string holes = beside([&](const Hole& hole) {
        Copies near_hole;
        for (std::size_t i = 0; i < stand.size(); ++i)
          if (plane_alone || !is_3d_ || reaches_to(others[i].pieces[k], hole, stand[i]))
            std::ranges::copy(of_each[i], std::back_inserter(near_hole));
        return near_hole;
      });
      if (!holes.empty())
        warnings.push_back(
            fmt::format("{} lies, as the vessels stand at the start, across the {}'s {}: what is drawn across a hole "
                        "is a wall there",
                        name_of_piece(others.front(), k), vessel_.name, holes));
    }
  }

  const std::vector<bool>& covered() const { return covered_; }

 private:
  /// "hole 1, hole 3 (50 % of it)", of what `copies_at(hole)` are beside; empty: of none.
  template <class CopiesAt>
  std::string beside(CopiesAt copies_at) {
    std::string holes;
    for (std::size_t h = 0; h < vessel_.holes.size(); ++h) {
      const Hole& hole = vessel_.holes[h];
      const Copies& copies = copies_at(hole);
      if (copies.empty()) continue;
      // Nothing comes from aside between the floor and what lies half a seed over it, and nothing leaves between what
      // lies a seed under the hole and the hole.
      const Near near{0.5 * seed_, hole.thickness + seed_};
      const bool is_turned = !plane_alone && copies.front().about;
      const Covered part = is_turned ? covered_by_turned(copies, hole, near) : covered_by_drawn_out(copies, hole, near);
      if (!part) continue;
      covered_[h] = true;
      holes += fmt::format("{}hole {}", holes.empty() ? "" : ", ", h + 1);
      if (*part < 0.995) holes += *part < 0.005 ? " (stands in it)" : fmt::format(" ({:.0f} % of it)", 100 * *part);
    }
    return holes;
  }

  const Vessel& vessel_;
  bool is_3d_;
  std::vector<bool> covered_;
  double seed_ = std::numeric_limits<double>::infinity();  // m, the thinnest
};

/// The holes that are covered, if only in part, by pieces of the vessel or of `others`: the other one and its images.
std::vector<bool> warn_of_covered_holes(const Scene& scene, const Vessel& vessel, const std::vector<Vessel>& others,
                                        Warnings& warnings) {
  CoveredHoles holes(scene, vessel);
  holes.warn_of_own(warnings);
  if (!others.empty()) holes.warn_of_pieces_of(others, warnings);
  return holes.covered();
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

/// Those of a periodic vessel stand again one period to either side, and no further.
void warn_of_pieces_beyond_periods(const Vessel& vessel, Warnings& warnings) {
  constexpr double rounding = 1e-9;  // m
  for (std::size_t k = 0; k < vessel.pieces.size(); ++k) {
    const WallPiece& piece = vessel.pieces[k];
    const Extent all = extent({piece});
    const bool is_along = !plane_alone && piece.drawn_out == DrawnOut::along;
    const auto warn = [&](Sides sides, double low, double high, double period, const char* direction) {
      const bool beyond = sides == Sides::periodic && (low < -period - rounding || high > 2 * period + rounding);
      if (beyond)
        warnings.push_back(
            fmt::format("{} reaches from {:.4g} mm to {:.4g} mm {} the periodic {}: what lies before {:.4g} mm or "
                        "beyond {:.4g} mm, "
                        "further than a period beside it, is no wall anywhere; draw it in the {}",
                        name_of_piece(vessel, k), 1e3 * low, 1e3 * high, direction, vessel.name, -1e3 * period,
                        2e3 * period, vessel.name));
      return beyond;
    };
    const double radius = std::max(piece.a.x(), piece.b.x()), depth = vessel.depth.value_or(0);
    if (!is_along && warn(vessel.sides, all.low.x(), all.high.x(), vessel.length, "along")) return;
    if (is_along && warn(vessel.front_and_back, all.low.x(), all.high.x(), depth, "across")) return;
    if (!plane_alone && piece.about &&
        warn(vessel.front_and_back, piece.about->y() - radius, piece.about->y() + radius, depth, "across"))
      return;  // one of a drawing says enough
  }
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
  std::vector<Vessel> hoppers = hopper_images(scene);
  if (scene.hopper) vessels.push_back(&*scene.hopper), hoppers.insert(hoppers.begin(), *scene.hopper);
  for (const Vessel* vessel : vessels) {
    const std::vector<Vessel> others = vessel == &scene.tray ? hoppers : std::vector<Vessel>{scene.tray};
    const std::vector<bool> covered = warn_of_covered_holes(scene, *vessel, others, warnings);
    warn_of_holes_shut_off(scene, *vessel, covered, warnings);
    warn_of_large_pieces(*vessel, warnings);
    warn_of_pieces_beyond_periods(*vessel, warnings);
    warn_of_pieces_below(scene, *vessel, warnings);
  }
  if (const std::optional<VesselsMeet> met = first_meeting_of_vessels(scene))
    warnings.push_back(fmt::format("hopper: passes through the tray, at {:.3g} s {} do", met->time, met->walls));
  warn_of_outlets_beside_tray(scene, warnings);
  return warnings;
}

}  // namespace vibrosow
