#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contact/effect_set.hpp"
#include "contact/pair_block.hpp"
#include "grains/grains.hpp"
#include "laws/law.hpp"
#include "plan/bed_loads.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a step is planned from: values of the scene, and what was derived from it.
struct StepBasis {
  const Scene& scene;
  const EffectSet& effects;
  const ContactParameters& contacts;
  const LawTraits& law;
  const std::vector<GrainKind>& seeds;     // by lot, whole
  const std::vector<GrainKind>& touching;  // touching_kinds
  const BedLoads& loads;
  double smallest_radius;  // m
};

struct StepLimit {
  std::string reason;
  double dt;  // s, the longest step that this limit allows
};

/// The step that a scene runs with and what bounds it (docs/explanation/theory.md).
struct StepPlan {
  double contact_duration;        // s, shortest elastic contact of any two grains
  std::vector<StepLimit> limits;  // each reason on its own
  double longest_safe;            // s, the smallest of the limits
  std::string bound_by;           // its reason
  double dt;                      // s, asked for or chosen
  /// What ContactParameters of the same names are to be for this step, 1/s.
  double steepest_sliding, steepest_rolling;
  bool too_long;       // dt > longest_safe
  std::int64_t steps;  // to the end of the run
};
StepPlan plan_step(const StepBasis& basis);

/// The shortest elastic contact of any two grains or a grain on a wall, s.
double shortest_contact(const StepBasis& basis);

/// Why the scene cannot run with its step, where that was written and the longest safe one; nothing when it can, or
/// when the scene insists (numerics.allow_long_step).
std::optional<std::string> step_refused(const Numerics& numerics, const StepPlan& plan);

/// What the shells will suffer, predicted from layers, acceleration and speed of impact, before any grain moves.
struct PredictedOverlap {
  double layers;                // of the deepest fill
  double overlap_at_rest;       // of the lowest grain at rest, on the floor
  double pair_overlap_at_rest;  // of the lowest pair in radii, twice the above
  double impact_speed;          // m/s, 2 A omega, or of falling seeds
  double overlap_at_impact;     // at that speed on a wall
  double stiff_enough;  // the largest contact.shell_compression that keeps both within guard.warn_relative_overlap
};
PredictedOverlap predict_overlap(const StepBasis& basis);

}  // namespace vibrosow
