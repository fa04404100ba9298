#include "simulation/vessel_motion.hpp"

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

Eigen::Vector2d vessel_displacement(const Vessel& vessel, double time) {
  if (!vessel.motion) return Eigen::Vector2d::Zero();
  const HarmonicMotion& m = *vessel.motion;
  return m.amplitude * ramp_at(m, time).size * std::sin(two_pi * m.frequency * time) * unit_direction(m);
}

Eigen::Vector2d vessel_velocity(const Vessel& vessel, double time) {
  if (!vessel.motion) return Eigen::Vector2d::Zero();
  const HarmonicMotion& m = *vessel.motion;
  const double phase = two_pi * m.frequency * time;
  const Ramp ramp = ramp_at(m, time);
  return m.amplitude * (ramp.rate * std::sin(phase) + ramp.size * two_pi * m.frequency * std::cos(phase)) *
         unit_direction(m);
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
