#pragma once

#include <optional>

#include "plan/model.hpp"

namespace vibrosow {

/// What `prepare` (plan/model.hpp) makes of a scene without an accuracy level; a level is left aside.
Model derive_model(const Scene& scene, const std::optional<EffectSet>& effects = std::nullopt);

// Of such a model, without planning its step.
PredictedOverlap overlap_as_written(const Scene& scene);
double contact_duration_as_written(const Scene& scene);  // s, of the shortest contact

}  // namespace vibrosow
