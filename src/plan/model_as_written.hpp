#pragma once

#include <optional>

#include "plan/model.hpp"

namespace vibrosow {

/// What `prepare` (plan/model.hpp) makes of a scene without an accuracy level; a level is left aside.
Model model_as_written(const Scene& scene, const std::optional<EffectSet>& effects = std::nullopt);

}  // namespace vibrosow
