#pragma once

#include "scene/scene.hpp"

namespace vibrosow {

/// How a vessel goes from one harmonic motion to another while a run goes on: over one shake of the slower one the old
/// one fades out and the new one in, by 3 p^2 - 2 p^3 of the part p that has passed. Displacement and velocity have no
/// jump, whatever has changed and whenever it begins.
struct MotionChange {
  HarmonicMotion after;  // as wanted; in phase with the old one in the middle of the change
  SumMotion course;      // the old one before, `after` from `until` on
  double until;          // s
};

/// From `time` (s) on. Both shake (`amplitude` or not) at more than 0 Hz, have the same ramp and stop never.
MotionChange change_motion(const HarmonicMotion& before, const HarmonicMotion& wanted, double time);

}  // namespace vibrosow
