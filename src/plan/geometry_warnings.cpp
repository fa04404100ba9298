#include "plan/geometry_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "grains/free_room.hpp"
#include "grains/turned_discs.hpp"
#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "scene/plane_alone.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/nearest_on_face.hpp"
#include "vessel/nearest_point.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/wall_points.hpp"
#include "vessel/walls.hpp"

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

/// m, or s.
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

// Vessels that pass through each other.

using Line = std::vector<Eigen::Vector3d>;

struct Box3 {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = Eigen::Vector3d::Constant(-1e300);

  void include(const Eigen::Vector3d& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
  double gap(const Box3& other) const {
    return (low - other.high).cwiseMax(other.low - high).cwiseMax(Eigen::Vector3d::Zero()).norm();
  }
  Eigen::Vector3d corner(int k) const {
    return {(k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z()};
  }
};

Box3 box_of(const Line& line) {
  Box3 box;
  for (const Eigen::Vector3d& point : line) box.include(point);
  return box;
}

/// Lines across a plate, but for its holes: vessels as deep as each other meet between their plates' edges.
std::vector<Line> lines_across(const Face& plate) {
  constexpr int lines = 3, parts = 16;
  std::vector<Line> across;
  const auto is_open = [&](double u, double v) {
    return std::ranges::any_of(
        plate.holes, [&](const RoundHole& hole) { return portable_math::hypot(u - hole.u, v - hole.v) < hole.radius; });
  };
  for (int line = 1; line <= lines; ++line)
    for (const bool along_u : {true, false}) {
      const double aside = static_cast<double>(line) / (lines + 1);
      const int count = plate.holes.empty() ? 1 : parts;
      for (int k = 0; k < count; ++k) {
        const auto u = [&](double part) { return plate.length_u * (along_u ? part : aside); };
        const auto v = [&](double part) { return plate.length_v * (along_u ? aside : part); };
        const double from = static_cast<double>(k) / count, to = (k + 1.0) / count, middle = 0.5 * (from + to);
        if (is_open(u(middle), v(middle))) continue;
        across.push_back({plate.origin + u(from) * plate.e1 + v(from) * plate.e2,
                          plate.origin + u(to) * plate.e1 + v(to) * plate.e2});
      }
    }
  return across;
}

/// Along which axes of the lab two vessels do not move past each other; where they are tilted or turn, along none of
/// the plane.
using StillAxes = std::array<bool, 3>;

/// m, how far a vessel moves along each axis of its frame: an upper bound.
Eigen::Array3d moved_along(const Vessel& vessel) {
  Eigen::Array3d moved = Eigen::Array3d::Zero();
  const auto add = [&moved](const HarmonicMotion& m) {
    const auto [up, along] = portable_math::sine_cosine(m.direction);
    const auto [across, in_plane] = portable_math::sine_cosine(m.across);
    moved += m.amplitude * Eigen::Array3d(along * in_plane, up * in_plane, across).abs();
  };
  const auto add_range = [&moved](int axis, const std::vector<double>& places) {
    if (places.empty()) return;
    const auto [least, most] = std::ranges::minmax(places);
    moved[axis] += most - least;
  };
  const VesselMotion* motion = vessel.motion && moves(*vessel.motion) ? &*vessel.motion : nullptr;
  if (const auto* harmonic = motion ? std::get_if<HarmonicMotion>(motion) : nullptr) add(*harmonic);
  if (const auto* sum = motion ? std::get_if<SumMotion>(motion) : nullptr)
    for (const HarmonicMotion& part : sum->components) add(part);
  if (const auto* table = motion ? std::get_if<TableMotion>(motion) : nullptr)
    add_range(0, table->x), add_range(1, table->y), add_range(2, table->z);
  if (vessel.tilt != 0 || (motion && turns(*motion)))
    moved.head<2>().setConstant(std::numeric_limits<double>::infinity());
  if (turns_steadily(vessel) && !turns_over(vessel)) moved.setConstant(std::numeric_limits<double>::infinity());
  return moved;
}

StillAxes still_axes(const Vessel& one, const Vessel& other) {
  constexpr double rounding = 1e-9;  // m
  const Eigen::Array3d moved = moved_along(one) + moved_along(other);
  return {moved.x() < rounding, moved.y() < rounding, moved.z() < rounding};
}

/// A vessel's walls in its own frame, as lines to be moved and as surfaces to be met. m.
class OwnWalls {
 public:
  OwnWalls(const Vessel& vessel, Space space)
      : vessel_(vessel), path_(vessel), walls_({at_rest(vessel)}, space), is_3d_(space != Space::two_dimensional) {
    if (is_3d())
      for (const Face& face : vessel_faces(vessel)) {
        walls_by_name_.push_back(face.name), boxes_.emplace_back();
        for (Line& line : face_lines(face)) add(std::move(line), face.name);
        if (face.kind == Face::Kind::plate && !face.round)
          for (Line& line : lines_across(face)) add(std::move(line), face.name);
      }
    else
      for (const WallSegment& wall : vessel_walls(vessel)) {
        walls_by_name_.push_back(wall.name), boxes_.emplace_back();
        Line line;
        for (const Eigen::Vector2d& point : wall_points(wall)) line.emplace_back(point.x(), point.y(), 0);
        add(std::move(line), wall.name);
      }
    for (Box3& box : boxes_) {  // arcs and rims are lines between points of theirs
      flat_along_.push_back(flat_along(box));
      const Eigen::Vector3d beyond = Eigen::Vector3d::Constant(1e-3 * (box.high - box.low).norm());
      box.low -= beyond, box.high += beyond;
    }
  }

  struct NamedLine {
    std::string name;
    Line points;
  };
  const std::vector<NamedLine>& lines() const { return lines_; }
  const Box3& box() const { return box_; }
  bool is_3d() const { return !plane_alone && is_3d_; }

  /// m, no more than from a line of this vessel's frame to the nearest wall that it may pass, where it does not move
  /// along the axes `still` and lies beyond a wall's surface by `slack` (m) at most; in 2D as near as the points
  /// of the line or of walls come, where they are nearer than `near`.
  double gap(const Line& line, double near, double slack, const StillAxes& still) const {
    const Box3 box = box_of(line);
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t wall = 0; wall < walls_.count(); ++wall) {
      const int flat = flat_along_[wall];
      if (flat >= 0 && still[static_cast<std::size_t>(flat)]) {
        const double at = 0.5 * (boxes_[wall].low[flat] + boxes_[wall].high[flat]);
        if (box.low[flat] > at - slack || box.high[flat] < at + slack) continue;  // it stays on its side
      }
      double apart = boxes_[wall].gap(box);
      if (apart < near && !is_3d()) {
        apart = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector3d& point : line) apart = std::min(apart, std::sqrt(walls_.distance2(wall, point)));
      }
      gap = std::min(gap, apart);
    }
    return gap;
  }

  /// m/s, of its fastest wall.
  double speed(double time) const {
    const Pose at = pose(time);
    const PoseRate rate = path_.rate(time);
    double fastest = 0;
    for (int k = 0; k < 8; ++k)
      fastest = std::max(fastest, point_velocity(vessel_, at, rate, to_lab(at, box_.corner(k))).norm());
    return fastest;
  }

  Pose pose(double time) const { return path_.pose(time); }
  Eigen::Vector3d to_lab(const Pose& pose, const Eigen::Vector3d& own) const {
    return point_in_lab(vessel_, pose, own);
  }
  Eigen::Vector3d from_lab(const Pose& pose, const Eigen::Vector3d& lab) const {
    return point_in_vessel(vessel_, pose, lab);
  }

  /// The wall that a straight way passes through, at least `slack` from the wall's own ends.
  const std::string* met_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double slack) const {
    const Box3 way = box_of({from, to});
    for (std::size_t wall = 0; wall < walls_.count(); ++wall)
      if (boxes_[wall].gap(way) == 0 && passes(wall, from, to, slack)) return &walls_by_name_[wall];
    return nullptr;
  }

  bool is_clear(const Eigen::Vector3d& at, double slack) const {
    for (std::size_t wall = 0; wall < walls_.count(); ++wall)
      if (boxes_[wall].gap({at, at}) <= slack && is_near(wall, at, slack)) return false;
    return true;
  }

 private:
  /// How a place stands to a wall: on which side, and whether over it and not beyond its ends.
  struct Seen {
    double side;
    bool beside;
  };

  static Vessel at_rest(Vessel vessel) {
    vessel.origin = Eigen::Vector2d::Zero(), vessel.tilt = 0, vessel.front = 0;
    vessel.motion.reset();
    return vessel;
  }

  /// The axis across a plate, or a line, that lies along the others; none: -1.
  int flat_along(const Box3& box) const {
    for (int axis = 0; axis < (is_3d() ? 3 : 2); ++axis)
      if (box.low[axis] == box.high[axis]) return axis;
    return -1;
  }

  void add(Line line, const std::string& name) {
    for (const Eigen::Vector3d& point : line) box_.include(point), boxes_.back().include(point);
    lines_.push_back({name, std::move(line)});
  }

  bool is_near(std::size_t wall, const Eigen::Vector3d& at, double slack) const {
    return walls_.distance2(wall, at) <= slack * slack;
  }

  Seen seen(std::size_t wall, const Eigen::Vector3d& at) const {
    if (is_3d()) {
      const NearestOnFace nearest = nearest_on_face(walls_.placed_faces()[wall], at);
      return {nearest.side, nearest.inside};
    }
    const NearestPoint nearest = nearest_point(walls_.placed()[wall], at.x(), at.y());
    return {nearest.side, nearest.inside};
  }

  /// Halves the way until it is where it meets the wall's surface.
  bool passes(std::size_t wall, Eigen::Vector3d begin, Eigen::Vector3d end, double slack) const {
    const double side = seen(wall, begin).side;
    if (!(side * seen(wall, end).side < 0) || is_near(wall, begin, slack) || is_near(wall, end, slack)) return false;
    for (int k = 0; k < 40; ++k) {
      const Eigen::Vector3d middle = 0.5 * (begin + end);
      (side * seen(wall, middle).side > 0 ? begin : end) = middle;
    }
    for (int axis = 0; axis < (is_3d() ? 3 : 2); ++axis)
      for (const double shift : {-slack, slack})
        if (!seen(wall, begin + shift * Eigen::Vector3d::Unit(axis)).beside) return false;
    return true;
  }

  const Vessel& vessel_;
  VesselPath path_;
  Walls walls_;
  bool is_3d_;
  std::vector<NamedLine> lines_;
  std::vector<std::string> walls_by_name_;
  std::vector<Box3> boxes_;      // by wall
  std::vector<int> flat_along_;  // by wall
  Box3 box_;
};

/// Follows the lines of one vessel past the other. What touches without going further than `slack` (m) does not pass.
class Passage {
 public:
  Passage(const OwnWalls& moved, const OwnWalls& other, double slack, const StillAxes& still)
      : moved_(moved), other_(other), slack_(slack), still_(still), clear_(moved.lines().size()) {}

  /// "tray floor 1 and hopper right wall", that pass through each other at `time` (s) or have since the last call.
  /// What is nearer than `near` (m) is looked at for how near it is. In 3D only that is looked
  /// at, so the times lie no further apart than `gap`, or `near`, allows.
  std::optional<std::string> at(double time, double near) {
    const Pose pose = moved_.pose(time), of_other = other_.pose(time);
    gap_ = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < moved_.lines().size(); ++k) {
      const auto& [name, own] = moved_.lines()[k];
      Line line;
      for (const Eigen::Vector3d& point : own) line.push_back(other_.from_lab(of_other, moved_.to_lab(pose, point)));
      const bool first = clear_[k].empty();
      if (first) clear_[k] = line;
      const double gap = other_.gap(line, near, slack_, still_);
      gap_ = std::min(gap_, gap);
      if (gap > near && other_.is_3d()) {
        clear_[k] = line;
        continue;
      }
      Box3 swept = box_of(line);
      for (const Eigen::Vector3d& point : clear_[k]) swept.include(point);
      if (swept.gap(other_.box()) > 0) {
        clear_[k] = line;
        continue;
      }
      const std::string* met = nullptr;
      for (std::size_t n = 1; n < line.size() && !met; ++n) met = crossed(line[n - 1], line[n]);
      for (std::size_t n = 0; n < line.size() && !met; ++n) met = other_.met_between(clear_[k][n], line[n], slack_);
      if (met) return fmt::format("{} and {}", name, *met);
      for (std::size_t n = 0; n < line.size(); ++n)
        if (other_.is_clear(line[n], slack_)) clear_[k][n] = line[n];
    }
    return std::nullopt;
  }

  /// m, no more than the lines were from the other vessel's walls at the last call.
  double gap() const { return gap_; }

 private:
  /// By the straight line between two of its points, further than `slack` from these.
  const std::string* crossed(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const double length = (to - from).norm();
    if (length <= 2 * slack_) return nullptr;
    const Eigen::Vector3d end = slack_ / length * (to - from);
    return other_.met_between(from + end, to - end, slack_);
  }

  const OwnWalls &moved_, &other_;
  double slack_;
  StillAxes still_;
  double gap_ = 0;
  std::vector<Line> clear_;  // by line, where its points were last that were on no wall
};

/// A part of a motion that swings, or turns: a point moves by at most `reach` s(t) sin(2 pi f t).
struct Swing {
  double frequency, reach;  // Hz, m
  double ramp, stop, stop_ramp;

  double acceleration() const { return 4 * std::numbers::pi * std::numbers::pi * frequency * frequency * reach; }
};

std::vector<Swing> swings_of(const Vessel& vessel) {
  std::vector<Swing> swings;
  if (!vessel.motion) return swings;
  const auto add = [&swings](const auto& m, double frequency, double reach) {
    swings.push_back({frequency, reach, m.ramp, m.stop, m.stop_ramp});
  };
  const double speed = motion_bounds(vessel).speed;
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&*vessel.motion))
    add(*harmonic, harmonic->frequency, harmonic->amplitude);
  else if (const auto* sum = std::get_if<SumMotion>(&*vessel.motion))
    for (const HarmonicMotion& part : sum->components) add(part, part.frequency, part.amplitude);
  else if (const auto* rocking = std::get_if<RockingMotion>(&*vessel.motion))
    add(*rocking, rocking->frequency, speed / (2 * std::numbers::pi * rocking->frequency));
  else if (const auto* turning = std::get_if<TurningMotion>(&*vessel.motion))
    add(*turning, std::abs(turning->angular_velocity) / (2 * std::numbers::pi),
        speed / std::abs(turning->angular_velocity));
  return swings;
}

/// Hz, of which both are multiples, to rounding.
double common_frequency(double a, double b) {
  const double rounding = 1e-6 * b;
  while (b > rounding) a = std::exchange(b, std::abs(std::remainder(a, b)));
  return a;
}

/// How two vessels move past each other over a run.
class Meeting {
 public:
  Meeting(const Scene& scene, const OwnWalls& tray, const OwnWalls& hopper) : tray_(tray), hopper_(hopper) {
    double table_ends = 0;
    for (const Vessel* vessel : {&scene.tray, &*scene.hopper}) {
      if (!vessel->motion || !moves(*vessel->motion)) continue;
      if (const auto* table = std::get_if<TableMotion>(&*vessel->motion))
        table_ends = std::max(table_ends, table->times.back()), acceleration_ += motion_bounds(*vessel).acceleration;
      for (const Swing& swing : swings_of(*vessel)) swings_.push_back(swing), acceleration_ += swing.acceleration();
    }
    const double duration = scene.run.duration;
    if (table_ends > 0)
      windows_ = {{0, swings_.empty() ? std::min(duration, table_ends) : duration}};
    else
      set_windows(duration);
  }

  /// s, in which all ways are seen that the vessels stand to each other: the rest of the run repeats them.
  const std::vector<Stretch>& windows() const { return windows_; }

  /// s, until `end` at most, in which no wall of one comes nearer to one of the other than by `way` (m).
  double time_for(double way, double time, double end) const {
    double acceleration = acceleration_, until = end - time;
    for (const Swing& swing : swings_) {
      const auto within = [&](double from, double length) {
        if (time < from) until = std::min(until, from - time);
        if (time < from || time >= from + length) return;
        until = std::min(until, from + length - time);
        // d2/dt2 of s(t) sin(w t), where s' is at most 3 / (2 length) and s'' 6 / length^2.
        acceleration += swing.reach * (6 * std::numbers::pi * swing.frequency / length + 6 / (length * length));
      };
      within(0, swing.ramp), within(swing.stop, swing.stop_ramp);
    }
    const double speed = tray_.speed(time) + hopper_.speed(time);
    const double most = speed + std::sqrt(speed * speed + 2 * acceleration * way);
    return most > 0 ? std::min(until, 2 * way / most) : until;
  }

 private:
  /// A motion repeats itself after its ramps and a period that all parts of it have in common. One part that stops does
  /// so within what was seen of it; of several each has its own amplitude then.
  void set_windows(double duration) {
    double common = 0, ramps = 0, first_stop = never, last_stop = 0;
    for (const Swing& swing : swings_) {
      common = common_frequency(common, swing.frequency);
      ramps = std::max(ramps, swing.ramp);
      first_stop = std::min(first_stop, swing.stop);
      if (swing.stop < duration) last_stop = std::max(last_stop, swing.stop + swing.stop_ramp);
    }
    const double period = common > 0 ? 1 / common : 0;
    windows_ = {{0, std::min(duration, ramps + period)}};
    if (swings_.size() == 1 || first_stop >= duration) return;
    if (first_stop <= windows_[0].to)
      windows_[0].to = std::min(duration, std::max(windows_[0].to, last_stop + period));
    else
      windows_.push_back({first_stop, std::min(duration, last_stop + period)});
  }

  const OwnWalls &tray_, &hopper_;
  std::vector<Stretch> windows_;
  double acceleration_ = 0;  // m/s2, of both, without ramps
  std::vector<Swing> swings_;
};

/// Looked at as often as it takes that no wall of one vessel goes a twentieth of a seed into the other unseen.
void warn_of_vessels_that_meet(const Scene& scene, Warnings& warnings) {
  if (!scene.hopper) return;
  double seed = std::numeric_limits<double>::infinity();
  for (const SeedLot& lot : scene.lots) seed = std::min(seed, mean_thickness(lot));
  const double slack = 0.01 * seed;   // what overlaps by less is meant to touch
  const double stride = 0.06 * seed;  // two looks lie within half of it of where a wall turns back
  const OwnWalls tray(scene.tray, scene.space), hopper(*scene.hopper, scene.space);
  const Meeting meeting(scene, tray, hopper);
  const StillAxes still = still_axes(scene.tray, *scene.hopper);
  for (const Stretch& window : meeting.windows()) {
    Passage of_tray(tray, hopper, slack, still), of_hopper(hopper, tray, slack, still);
    for (double time = window.from;;) {
      std::optional<std::string> met = of_tray.at(time, stride);
      if (!met) met = of_hopper.at(time, stride);
      if (met) {
        warnings.push_back(fmt::format("hopper: passes through the tray, at {:.3g} s {} do", time, *met));
        return;
      }
      if (time >= window.to) break;
      const double apart = std::min(of_tray.gap(), of_hopper.gap());
      time = std::min(window.to, time + meeting.time_for(std::max(stride, apart), time, window.to));
    }
  }
}

/// How far (m) places of a hopper's floor reach along and across the tray, in the tray's frame, where what leaves them
/// comes to the tray's mouth: straight down to the height of its end walls, without these to its floor.
Box3 fallen_to_tray(const Scene& scene, const std::vector<Eigen::Vector3d>& places) {
  const Vessel &tray = scene.tray, &hopper = *scene.hopper;
  const Pose of_tray = vessel_pose(tray, 0), of_hopper = vessel_pose(hopper, 0);
  const double mouth = tray.sides == Sides::walls ? tray.height : 0;
  Box3 box;
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
    const Box3 over = fallen_to_tray(scene, {middle - along, middle + along});
    if (tray.sides != Sides::periodic && (over.low.x() < -slack || over.high.x() > tray.length + slack))
      warn(over.low.x(), over.high.x(), fmt::format("of the tray, which is {} long", in_mm(tray.length)));
    if (!is_3d || tray.front_and_back == Sides::periodic) continue;
    const Eigen::Vector3d across(0, 0, half_across);
    const Box3 beside = fallen_to_tray(scene, {middle - across, middle + across});
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
  warn_of_vessels_that_meet(scene, warnings);
  warn_of_outlets_beside_tray(scene, warnings);
  return warnings;
}

}  // namespace vibrosow
