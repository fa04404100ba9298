#pragma once

#include <string>
#include <vector>

#include "contact/effect_set.hpp"
#include "laws/law.hpp"
#include "scene/scene.hpp"
#include "scene/surfaces.hpp"

namespace vibrosow {

/// Derived from the scene: a key at its neutral value means that the effect is absent.
EffectSet effects_of(const Scene& scene, const Surfaces& surfaces, const LawTraits& law);

/// Names of the effects present, in the order above: {"friction", "damping"}.
std::vector<std::string> effect_names(const EffectSet& effects);

struct EffectReason {
  std::string effect;
  bool present;
  std::string reason;  // "contact.restitution = 0.5", "every lot has the same diameter, mass and shape"
};
/// One line an effect, present or absent, for `check`.
std::vector<EffectReason> explain_effects(const Scene& scene, const EffectSet& effects, const LawTraits& law);

}  // namespace vibrosow
