#include "simulation/vessel_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vibrosow {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

Eigen::Vector2d unit_direction(const HarmonicMotion& motion) {
  return {std::cos(motion.direction), std::sin(motion.direction)};
}

/// Size s of the ramp and its rate (1/s).
struct Ramp {
  double size = 1, rate = 0;
};
Ramp ramp_at(const HarmonicMotion& motion, double time) {
  if (time >= motion.ramp) return {};
  const double part = time / motion.ramp;
  return {part * part * (3 - 2 * part), 6 * part * (1 - part) / motion.ramp};
}

}  // namespace

Pose vessel_pose(const Vessel& vessel, double time) {
  if (!vessel.motion) return {};
  const HarmonicMotion& m = *vessel.motion;
  return {m.amplitude * ramp_at(m, time).size * std::sin(two_pi * m.frequency * time) * unit_direction(m), 0};
}

PoseRate vessel_velocity(const Vessel& vessel, double time) {
  if (!vessel.motion) return {};
  const HarmonicMotion& m = *vessel.motion;
  const double phase = two_pi * m.frequency * time;
  const Ramp ramp = ramp_at(m, time);
  return {m.amplitude * (ramp.rate * std::sin(phase) + ramp.size * two_pi * m.frequency * std::cos(phase)) *
              unit_direction(m),
          0};
}

Eigen::Vector2d in_lab_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& own) {
  const double angle = vessel.tilt + pose.angle;
  if (angle == 0) return vessel.origin + pose.displacement + own;
  return vessel.origin + pose.displacement + Eigen::Rotation2Dd(angle) * own;
}

Eigen::Vector2d in_vessel_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& lab) {
  const Eigen::Vector2d moved = lab - vessel.origin - pose.displacement;
  const double angle = vessel.tilt + pose.angle;
  if (angle == 0) return moved;
  return Eigen::Rotation2Dd(-angle) * moved;
}

Eigen::Vector2d material_velocity(const Vessel& vessel, const Pose& pose, const PoseRate& rate,
                                  const Eigen::Vector2d& lab) {
  if (rate.angular_velocity == 0) return rate.velocity;
  const Eigen::Vector2d arm = lab - vessel.origin - pose.displacement;
  return rate.velocity + rate.angular_velocity * Eigen::Vector2d(-arm.y(), arm.x());
}

double largest_acceleration(const Vessel& vessel) {
  if (!vessel.motion) return 0;
  const double omega = two_pi * vessel.motion->frequency;
  return vessel.motion->amplitude * omega * omega;
}

double largest_speed(const Vessel& vessel) {
  return vessel.motion ? vessel.motion->amplitude * two_pi * vessel.motion->frequency : 0;
}

}  // namespace vibrosow
