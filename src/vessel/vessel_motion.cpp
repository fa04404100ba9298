#include "vessel/vessel_motion.hpp"

#include <algorithm>
#include <array>
#include <boost/math/interpolators/cubic_hermite.hpp>
#include <boost/math/interpolators/makima.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "vessel/directions.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// A size between 0 and 1 and its rate (1/s).
struct Ramp {
  double size = 1, rate = 0;
};

Ramp smooth_rise(double part, double duration) {
  return {part * part * (3 - 2 * part), 6 * part * (1 - part) / duration};
}

template <class Motion>
Ramp ramp_at(const Motion& motion, double time) {
  Ramp ramp;
  if (time < motion.ramp) ramp = smooth_rise(time / motion.ramp, motion.ramp);
  if (time < motion.stop) return ramp;
  if (time >= motion.stop + motion.stop_ramp) return {0, 0};
  const Ramp fallen = smooth_rise((time - motion.stop) / motion.stop_ramp, motion.stop_ramp);
  return {ramp.size * (1 - fallen.size), ramp.rate * (1 - fallen.size) - ramp.size * fallen.rate};
}

/// s(t) sin(2 pi f t + phase) and its rate.
template <class Motion>
Ramp swing(const Motion& m, double phase, double time) {
  const double angle = two_pi * m.frequency * time + phase;
  const Ramp ramp = ramp_at(m, time);
  const auto [sine, cosine] = portable_math::sine_cosine(angle);
  return {ramp.size * sine, ramp.rate * sine + ramp.size * two_pi * m.frequency * cosine};
}

/// What part of a motion lies in the plane of length and height, and across it.
struct Parts {
  double in_plane = 1, across = 0;
};
Parts parts_of(const HarmonicMotion& m) {
  if (m.across == 0) return {};
  const auto [sine, cosine] = portable_math::sine_cosine(m.across);
  return {cosine, sine};
}

Pose harmonic_pose(const HarmonicMotion& m, double time) {
  const double size = m.amplitude * swing(m, m.phase, time).size;
  const Parts parts = parts_of(m);
  return {(size * parts.in_plane) * unit_vector(m.direction), 0, size * parts.across};
}

PoseRate harmonic_rate(const HarmonicMotion& m, double time) {
  const double rate = m.amplitude * swing(m, m.phase, time).rate;
  const Parts parts = parts_of(m);
  return {(rate * parts.in_plane) * unit_vector(m.direction), 0, rate * parts.across};
}

Eigen::Vector2d turned_left(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

/// The frame's zero moves so that the pivot stays: displacement = R(tilt) p - R(tilt + angle) p.
Pose rocking_pose(const RockingMotion& m, double tilt, double time) {
  const double angle = m.angle * swing(m, 0, time).size;
  const Eigen::Vector2d at_rest = rotation(tilt) * m.pivot;
  return {at_rest - rotation(tilt + angle) * m.pivot, angle, 0};
}

PoseRate rocking_rate(const RockingMotion& m, double tilt, double time) {
  const Ramp now = swing(m, 0, time);
  const double spin = m.angle * now.rate;
  return {-spin * turned_left(rotation(tilt + m.angle * now.size) * m.pivot), spin, 0};
}

/// The integral of s from 0 to `time`, s. Between its breaks s is a polynomial of degree 6 or less, of which Gauss's
/// rule with four points is exact.
double time_at_full_speed(const TurningMotion& m, double time) {
  constexpr std::array<std::pair<double, double>, 2> places_and_weights = {
      {{0.3399810435848563, 0.6521451548625461}, {0.8611363115940526, 0.3478548451374538}}};
  std::array<double, 4> breaks = {m.ramp, m.stop, m.stop + m.stop_ramp, time};
  std::ranges::sort(breaks);
  double sum = 0, from = 0;
  for (const double end : breaks) {
    const double to = std::min(end, time), middle = 0.5 * (from + to), half = 0.5 * (to - from);
    if (half <= 0) continue;
    for (const auto& [place, weight] : places_and_weights)
      sum += half * weight * (ramp_at(m, middle - half * place).size + ramp_at(m, middle + half * place).size);
    from = to;
  }
  return sum;
}

double turned_by(const TurningMotion& m, double time) {
  return m.phase + m.angular_velocity * time_at_full_speed(m, time);
}

/// As rocking does; about an upright axis the frame's zero moves along and across.
Pose turning_pose(const TurningMotion& m, double tilt, double time) {
  const double angle = turned_by(m, time);
  if (m.axis == TurningAxis::across) return {rotation(tilt) * m.pivot - rotation(tilt + angle) * m.pivot, angle, 0};
  const Eigen::Vector2d moved = m.pivot - rotation(angle) * m.pivot;
  return {moved.x() * unit_vector(tilt), 0, moved.y(), angle};
}

PoseRate turning_rate(const TurningMotion& m, double tilt, double time) {
  const double spin = m.angular_velocity * ramp_at(m, time).size;
  const double angle = turned_by(m, time);
  if (m.axis == TurningAxis::across) return {-spin * turned_left(rotation(tilt + angle) * m.pivot), spin, 0};
  const Eigen::Vector2d velocity = -spin * turned_left(rotation(angle) * m.pivot);
  return {velocity.x() * unit_vector(tilt), 0, velocity.y(), spin};
}

void add(Pose& sum, const Pose& part) {
  sum.displacement += part.displacement, sum.across += part.across;
}
void add(PoseRate& sum, const PoseRate& part) {
  sum.velocity += part.velocity, sum.across_velocity += part.across_velocity;
}

using Curve = boost::math::interpolators::cubic_hermite<std::vector<double>>;

/// Whether a vessel holds still from row `k` of a table to the next: they are equal, and further apart than rows beside
/// them that differ. Equal rows of a signal that is sampled evenly may lie on both sides of its peak.
bool is_hold(const std::vector<double>& times, const std::vector<double>& values, std::size_t k) {
  constexpr double longer = 1.5;
  if (values[k] != values[k + 1]) return false;
  const auto moves_faster = [&](std::size_t row) {
    return values[row] != values[row + 1] && longer * (times[row + 1] - times[row]) < times[k + 1] - times[k];
  };
  return (k > 0 && moves_faster(k - 1)) || (k + 2 < times.size() && moves_faster(k + 1));
}

/// Modified Akima, at rest at both ends, so that the velocity is continuous there too. From a hold it would go on as it
/// came, by the more the longer the hold: there the slopes are 0.
Curve curve(std::vector<double> times, std::vector<double> values) {
  using Numbers = std::vector<double>;
  const boost::math::interpolators::makima<Numbers> akima(Numbers(times), Numbers(values), 0.0, 0.0);
  Numbers slopes;
  for (const double time : times) slopes.push_back(akima.prime(time));
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    if (is_hold(times, values, k)) slopes[k] = slopes[k + 1] = 0;
  return Curve(std::move(times), std::move(values), std::move(slopes));
}

}  // namespace

struct VesselPath::Curves {
  explicit Curves(const TableMotion& table)
      : first(table.times.front()),
        last(table.times.back()),
        x(curve(table.times, table.x)),
        y(curve(table.times, table.y)),
        angle(curve(table.times, table.angle)) {
    if (!table.z.empty()) z.emplace(curve(table.times, table.z));
  }

  Pose pose(double time) const {
    const double t = std::clamp(time, first, last);
    return {{x(t), y(t)}, angle(t), z ? (*z)(t) : 0};
  }
  PoseRate rate(double time) const {
    if (time <= first || time >= last) return {};
    return {{x.prime(time), y.prime(time)}, angle.prime(time), z ? z->prime(time) : 0};
  }

  double first, last;  // s
  Curve x, y, angle;
  std::optional<Curve> z;
};

Overshoot largest_overshoot(const TableMotion& table) {
  constexpr int samples = 16;
  Overshoot most;
  for (const auto& [name, values] : {std::pair<std::string_view, const std::vector<double>*>{"x_mm", &table.x},
                                     {"y_mm", &table.y},
                                     {"z_mm", &table.z},
                                     {"angle_degree", &table.angle}}) {
    if (values->empty()) continue;
    const double stroke = std::ranges::max(*values) - std::ranges::min(*values);
    if (stroke == 0) continue;
    const Curve path = curve(table.times, *values);
    for (std::size_t k = 1; k < table.times.size(); ++k) {
      const double from = table.times[k - 1], to = table.times[k], before = (*values)[k - 1], after = (*values)[k];
      for (int part = 1; part < samples; ++part) {
        const double at = path(from + part * (to - from) / samples);
        const double beyond = std::max(std::min(before, after) - at, at - std::max(before, after)) / stroke;
        if (beyond > most.share) most = {name, beyond, from, to};
      }
    }
  }
  return most;
}

VesselPath::VesselPath(const Vessel& vessel) : tilt_(vessel.tilt), motion_(vessel.motion) {
  if (!motion_) return;
  if (const auto* table = std::get_if<TableMotion>(&*motion_)) curves_ = std::make_shared<Curves>(*table);
}

Pose VesselPath::pose(double time) const {
  if (!motion_) return {};
  if (curves_) return curves_->pose(time);
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&*motion_)) return harmonic_pose(*harmonic, time);
  if (const auto* rocking = std::get_if<RockingMotion>(&*motion_)) return rocking_pose(*rocking, tilt_, time);
  if (const auto* turning = std::get_if<TurningMotion>(&*motion_)) return turning_pose(*turning, tilt_, time);
  Pose sum;
  for (const HarmonicMotion& component : std::get<SumMotion>(*motion_).components)
    add(sum, harmonic_pose(component, time));
  return sum;
}

PoseRate VesselPath::rate(double time) const {
  if (!motion_) return {};
  if (curves_) return curves_->rate(time);
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&*motion_)) return harmonic_rate(*harmonic, time);
  if (const auto* rocking = std::get_if<RockingMotion>(&*motion_)) return rocking_rate(*rocking, tilt_, time);
  if (const auto* turning = std::get_if<TurningMotion>(&*motion_)) return turning_rate(*turning, tilt_, time);
  PoseRate sum;
  for (const HarmonicMotion& component : std::get<SumMotion>(*motion_).components)
    add(sum, harmonic_rate(component, time));
  return sum;
}

Pose vessel_pose(const Vessel& vessel, double time) {
  return VesselPath(vessel).pose(time);
}

PoseRate vessel_velocity(const Vessel& vessel, double time) {
  return VesselPath(vessel).rate(time);
}

Eigen::Vector2d in_lab_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& own) {
  const double angle = vessel.tilt + pose.angle;
  if (angle == 0) return vessel.origin + pose.displacement + own;
  return vessel.origin + pose.displacement + rotation(angle) * own;
}

Eigen::Vector2d in_vessel_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& lab) {
  Eigen::Vector2d moved = lab - vessel.origin - pose.displacement;
  const double angle = vessel.tilt + pose.angle;
  if (angle == 0) return moved;
  return rotation(-angle) * moved;
}

namespace {

/// About the upright axis, x towards z.
Eigen::Vector3d turned(const Eigen::Vector3d& v, double angle) {
  if (angle == 0) return v;
  const Eigen::Vector2d in_plan = rotation(angle) * Eigen::Vector2d(v.x(), v.z());
  return {in_plan.x(), v.y(), in_plan.y()};
}

}  // namespace

Eigen::Vector3d direction_in_lab(const Vessel& vessel, const Pose& pose, const Eigen::Vector3d& own) {
  Eigen::Vector3d level = turned(own, pose.turn);
  const double angle = vessel.tilt + pose.angle;
  if (angle == 0) return level;
  const Eigen::Vector2d in_plane = rotation(angle) * Eigen::Vector2d(level.x(), level.y());
  return {in_plane.x(), in_plane.y(), level.z()};
}

Eigen::Vector3d point_in_lab(const Vessel& vessel, const Pose& pose, const Eigen::Vector3d& own) {
  const Eigen::Vector3d level = turned(own, pose.turn);
  const Eigen::Vector2d in_plane = in_lab_frame(vessel, pose, Eigen::Vector2d(level.x(), level.y()));
  return {in_plane.x(), in_plane.y(), vessel.front + pose.across + level.z()};
}

Eigen::Vector3d point_in_vessel(const Vessel& vessel, const Pose& pose, const Eigen::Vector3d& lab) {
  const Eigen::Vector2d in_plane = in_vessel_frame(vessel, pose, Eigen::Vector2d(lab.x(), lab.y()));
  return turned({in_plane.x(), in_plane.y(), lab.z() - pose.across - vessel.front}, -pose.turn);
}

Eigen::Vector2d material_velocity(const Vessel& vessel, const Pose& pose, const PoseRate& rate,
                                  const Eigen::Vector2d& lab) {
  if (rate.angular_velocity == 0) return rate.velocity;
  return rate.velocity + rate.angular_velocity * turned_left(lab - vessel.origin - pose.displacement);
}

Pose steady_frame(const Vessel& vessel, const Pose& pose) {
  return turns_steadily(vessel) ? Pose{} : pose;
}

bool stands(const Vessel& vessel, const Pose& pose) {
  constexpr double least = 0.5 - 1e-9;
  return portable_math::cos(vessel.tilt + pose.angle) >= least;
}

namespace {

/// Height (m, lab, from the origin) below which a vessel moved by a table never reaches, if it ever does not stand.
std::optional<double> lowest_where_tipped(const Vessel& vessel, const TableMotion& table) {
  constexpr int samples = 16;  // from one time of the table to the next
  const VesselPath path(vessel);
  double lowest = std::numeric_limits<double>::infinity();
  bool tipped = false;
  for (std::size_t k = 0; k < table.times.size(); ++k)
    for (int part = 0; part < samples; ++part) {
      const double next = table.times[std::min(k + 1, table.times.size() - 1)];
      const Pose pose = path.pose(table.times[k] + part * (next - table.times[k]) / samples);
      tipped = tipped || !stands(vessel, pose);
      lowest = std::min(lowest, pose.displacement.y());
    }
  if (!tipped) return std::nullopt;
  return lowest - largest_radius(vessel, Eigen::Vector2d::Zero());
}

}  // namespace

std::optional<Pose> line_below(const Vessel& vessel) {
  if (const auto* table = vessel.motion ? std::get_if<TableMotion>(&*vessel.motion) : nullptr) {
    const std::optional<double> lowest = lowest_where_tipped(vessel, *table);
    return lowest ? std::optional(Pose{{0, *lowest}, -vessel.tilt}) : std::nullopt;
  }
  if (!turns_over(vessel)) return std::nullopt;
  const Eigen::Vector2d& pivot = std::get<TurningMotion>(*vessel.motion).pivot;
  const double axis = (rotation(vessel.tilt) * pivot).y();
  return Pose{{0, axis - largest_radius(vessel, pivot)}, -vessel.tilt};
}

Eigen::Vector3d aside_while_rising(const Vessel& vessel, const Pose& pose, double rise) {
  const Eigen::Vector3d floor = point_in_vessel(vessel, pose, Eigen::Vector3d::Zero());
  Eigen::Vector3d up = point_in_vessel(vessel, pose, Eigen::Vector3d::UnitY()) - floor;
  up *= rise / up.y();
  return {up.x(), 0, up.z()};
}

Eigen::Vector3d spin_3d(const Vessel& vessel, const Pose& pose, const PoseRate& rate) {
  if (rate.turn_rate == 0) return {0, 0, rate.angular_velocity};
  const Eigen::Vector2d up = turned_left(unit_vector(vessel.tilt + pose.angle));
  return {-rate.turn_rate * up.x(), -rate.turn_rate * up.y(), rate.angular_velocity};
}

Eigen::Vector3d point_velocity(const Vessel& vessel, const Pose& pose, const PoseRate& rate,
                               const Eigen::Vector3d& lab) {
  const Eigen::Vector3d arm = lab - point_in_lab(vessel, pose, Eigen::Vector3d::Zero());
  return Eigen::Vector3d(rate.velocity.x(), rate.velocity.y(), rate.across_velocity) +
         cross(spin_3d(vessel, pose, rate), arm);
}

namespace {

MotionBounds bounds(const HarmonicMotion& m) {
  const double omega = two_pi * m.frequency;
  const double acceleration = m.amplitude * omega * omega;
  const double upward = std::abs(portable_math::sin(m.direction)) * std::abs(parts_of(m).in_plane);
  const Parts parts = parts_of(m);
  const double level = portable_math::hypot(parts.in_plane * portable_math::cos(m.direction), parts.across);
  return {m.amplitude * two_pi * m.frequency, acceleration, acceleration * upward, std::abs(m.amplitude) * level, 0};
}

MotionBounds bounds(const SumMotion& sum) {
  MotionBounds all;
  for (const HarmonicMotion& component : sum.components) {
    const MotionBounds one = bounds(component);
    all.speed += one.speed, all.acceleration += one.acceleration;
    all.vertical_acceleration += one.vertical_acceleration, all.displacement += one.displacement;
  }
  return all;
}

MotionBounds bounds(const RockingMotion& m, const Vessel& vessel) {
  const double omega = two_pi * m.frequency, reach = m.angle * largest_radius(vessel, m.pivot);
  return {reach * omega, reach * omega * omega, reach * omega * omega, std::abs(reach), std::abs(m.angle)};
}

MotionBounds bounds(const TurningMotion& m, const Vessel& vessel) {
  const double omega = std::abs(m.angular_velocity);
  if (m.axis == TurningAxis::across) {
    const double reach = largest_radius(vessel, m.pivot);
    return {reach * omega, reach * omega * omega, reach * omega * omega, 2 * reach, std::numbers::pi};
  }
  const double reach = largest_radius_in_plan(vessel, m.pivot), acceleration = reach * omega * omega;
  return {reach * omega, acceleration, acceleration * std::abs(portable_math::sin(vessel.tilt)), 2 * reach, 0};
}

/// Velocity is quadratic in time between two times of the table, acceleration linear.
MotionBounds sampled_bounds(const TableMotion& table, const Vessel& vessel) {
  constexpr int samples = 16;
  const VesselPath path(vessel);
  const double radius = largest_radius(vessel, Eigen::Vector2d::Zero());
  MotionBounds most;
  for (std::size_t k = 1; k < table.times.size(); ++k) {
    const double from = table.times[k - 1], step = (table.times[k] - from) / samples;
    PoseRate before = path.rate(from);
    for (int part = 1; part <= samples; ++part) {
      const PoseRate now = path.rate(from + part * step);
      const Eigen::Vector2d acceleration = (now.velocity - before.velocity) / step;
      const double across = std::abs(now.across_velocity),
                   faster = std::abs(now.across_velocity - before.across_velocity);
      const double spin = std::abs(now.angular_velocity);
      const double turning = radius * (std::abs(now.angular_velocity - before.angular_velocity) / step + spin * spin);
      most.speed = std::max(most.speed, now.velocity.norm() + across + spin * radius);
      most.acceleration = std::max(most.acceleration, acceleration.norm() + faster / step + turning);
      most.vertical_acceleration = std::max(most.vertical_acceleration, std::abs(acceleration.y()) + turning);
      const Pose pose = path.pose(from + part * step);
      const double aside = portable_math::hypot(pose.displacement.x(), pose.across) + std::abs(pose.angle) * radius;
      most.displacement = std::max(most.displacement, aside);
      most.angle = std::max(most.angle, std::abs(pose.angle));
      before = now;
    }
  }
  return most;
}

}  // namespace

MotionBounds motion_bounds(const Vessel& vessel) {
  if (!vessel.motion) return {};
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&*vessel.motion)) return bounds(*harmonic);
  if (const auto* sum = std::get_if<SumMotion>(&*vessel.motion)) return bounds(*sum);
  if (const auto* rocking = std::get_if<RockingMotion>(&*vessel.motion)) return bounds(*rocking, vessel);
  if (const auto* turning = std::get_if<TurningMotion>(&*vessel.motion)) return bounds(*turning, vessel);
  return sampled_bounds(std::get<TableMotion>(*vessel.motion), vessel);
}

}  // namespace vibrosow
