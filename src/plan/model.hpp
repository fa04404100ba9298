#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact/effect_set.hpp"
#include "contact/kernels.hpp"
#include "grains/grains.hpp"
#include "laws/law.hpp"
#include "plan/bed_loads.hpp"
#include "plan/step_plan.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A scene with everything that is derived from it, once: what a simulation is given. Const from then on; nothing that
/// takes a Model derives anything from its scene again.
struct Model {
  Scene scene;                  // softness and steps of its accuracy level written out
  std::vector<Vessel> vessels;  // of the scene, the tray first; behind them a hopper's images
  const LawTraits* law;
  EffectSet effects;
  const KernelSet* kernels;      // compiled for just these effects
  std::vector<GrainKind> kinds;  // by lot, of its diameter
  ContactParameters contacts;
  double smallest_radius;   // m, of any seed or disc there can be
  double largest_diameter;  // m, of any seed there can be; of a clump: of the circle that holds it
  double carried_beyond;    // m, a side of a periodic tray: further on a grain goes on at the other one
  Eigen::Vector2d gravity{0, -standard_gravity};  // m/s2
  BedLoads loads;
  StepPlan step;
  PredictedOverlap overlap;
};

/// `effects`: to run with more than the scene calls for, or to leave some out. Throws std::logic_error when no kernel
/// is compiled for them, InputError where a vessel in 3D has no depth, or a clump not the inertia of its space.
Model prepare(const Scene& scene, const std::optional<EffectSet>& effects = std::nullopt);

/// The same; throws InputError where the step that the scene asks for is too long and not insisted on.
Model prepare_to_run(const Scene& scene);

}  // namespace vibrosow
