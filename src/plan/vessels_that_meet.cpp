#include "plan/vessels_that_meet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "scene/plane_alone.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/bounding_box.hpp"
#include "vessel/nearest_on_face.hpp"
#include "vessel/nearest_point.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/wall_points.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {
namespace {

using Line = std::vector<Eigen::Vector3d>;

BoundingBox box_of(const Line& line) {
  BoundingBox box;
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
    for (BoundingBox& box : boxes_) {  // arcs and rims are lines between points of theirs
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
  const BoundingBox& box() const { return box_; }
  bool is_3d() const { return !plane_alone && is_3d_; }

  /// m, no more than from a line of this vessel's frame to the nearest wall that it may pass, where it does not move
  /// along the axes `still` and lies beyond a wall's surface by `slack` (m) at most; in 2D as near as the points
  /// of the line or of walls come, where they are nearer than `near`.
  double gap(const Line& line, double near, double slack, const StillAxes& still) const {
    const BoundingBox box = box_of(line);
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
    const BoundingBox way = box_of({from, to});
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
  int flat_along(const BoundingBox& box) const {
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
  std::vector<BoundingBox> boxes_;  // by wall
  std::vector<int> flat_along_;     // by wall
  BoundingBox box_;
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
      BoundingBox swept = box_of(line);
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

/// s.
struct Window {
  double from, to;
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
class RelativeMotion {
 public:
  RelativeMotion(const Scene& scene, const OwnWalls& tray, const OwnWalls& hopper) : tray_(tray), hopper_(hopper) {
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
  const std::vector<Window>& windows() const { return windows_; }

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
  std::vector<Window> windows_;
  double acceleration_ = 0;  // m/s2, of both, without ramps
  std::vector<Swing> swings_;
};

}  // namespace

/// Looked at as often as it takes that no wall of one vessel goes a twentieth of a seed into the other unseen.
std::optional<VesselsMeet> first_meeting_of_vessels(const Scene& scene) {
  if (!scene.hopper) return std::nullopt;
  double seed = std::numeric_limits<double>::infinity();
  for (const SeedLot& lot : scene.lots) seed = std::min(seed, mean_thickness(lot));
  const double slack = 0.01 * seed;   // what overlaps by less is meant to touch
  const double stride = 0.06 * seed;  // two looks lie within half of it of where a wall turns back
  const OwnWalls tray(scene.tray, scene.space), hopper(*scene.hopper, scene.space);
  const RelativeMotion motion(scene, tray, hopper);
  const StillAxes still = still_axes(scene.tray, *scene.hopper);
  for (const Window& window : motion.windows()) {
    Passage of_tray(tray, hopper, slack, still), of_hopper(hopper, tray, slack, still);
    for (double time = window.from;;) {
      std::optional<std::string> met = of_tray.at(time, stride);
      if (!met) met = of_hopper.at(time, stride);
      if (met) return VesselsMeet{time, *met};
      if (time >= window.to) break;
      const double apart = std::min(of_tray.gap(), of_hopper.gap());
      time = std::min(window.to, time + motion.time_for(std::max(stride, apart), time, window.to));
    }
  }
  return std::nullopt;
}

}  // namespace vibrosow
