#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

struct StepLimit {
  std::string reason;
  double dt;  // s, the longest step that this limit allows
};

/// The step that a scene runs with and what bounds it (PHYSICS in ARCHITECTURE.md).
struct StepPlan {
  double contact_duration;        // s, shortest elastic contact of any two grains
  std::vector<StepLimit> limits;  // each reason on its own
  double longest_safe;            // s, the smallest of the limits
  std::string bound_by;           // its reason
  double dt;                      // s, asked for or chosen
  bool too_long;                  // dt > longest_safe
  std::int64_t steps;             // to the end of the run
};
StepPlan plan_step(const Scene& scene);

/// Why the scene cannot run with its step, where that was written and the longest safe one; nothing when it can, or
/// when the scene insists (numerics.allow_long_step).
std::optional<std::string> step_refused(const Scene& scene, const StepPlan& plan);

/// What the shells will suffer, predicted from layers, acceleration and speed of impact, before any grain moves.
struct PredictedCompression {
  double layers;              // of the deepest fill
  double static_compression;  // d/r of the lowest shell at rest
  double static_overlap;      // of the lowest pair in radii, twice the above
  double impact_speed;        // m/s, 2 A omega
  double impact_compression;  // d/r at that speed on a wall
  double stiff_enough;        // the largest contact.shell_compression that keeps both within guard.warn_compression
};
PredictedCompression predict_compression(const Scene& scene);

}  // namespace vibrosow
