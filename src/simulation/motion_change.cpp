#include "simulation/motion_change.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrosow {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

HarmonicMotion fading(HarmonicMotion motion, double from, double duration) {
  motion.stop = from, motion.stop_ramp = duration;
  return motion;
}

}  // namespace

MotionChange change_motion(const HarmonicMotion& before, const HarmonicMotion& wanted, double time) {
  const double duration = 1 / std::min(before.frequency, wanted.frequency), middle = time + 0.5 * duration;
  HarmonicMotion after = wanted;
  after.phase = std::remainder(before.phase + two_pi * (before.frequency - wanted.frequency) * middle, two_pi);
  HarmonicMotion lacking = after;  // what `after` still lacks
  lacking.amplitude = -after.amplitude;
  return {after, {{fading(before, time, duration), after, fading(lacking, time, duration)}}, time + duration};
}

}  // namespace vibrosow
