#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What a scene's contacts and motion call for. An effect that is absent costs nothing.
struct EffectSet {
  bool friction = false;
  bool rotation = false;  // only with friction, or of clumps
  bool damping = false;
  bool unequal = false;            // grains of more than one diameter, mass, shape or material
  bool drag = false;               // not part of the pair force: chosen in the integrator
  bool motion = false;             // a vessel moves: chosen in the loop
  bool tangential_spring = false;  // friction holds by a spring, and contacts remember
  Rolling rolling = Rolling::none;
  bool cohesion = false;
  bool clumps = false;    // a grain is several discs: the kernels see discs
  bool periodic = false;  // pairs across the seam are a list of their own

  bool operator==(const EffectSet&) const = default;
};

/// Derived from the scene: a key at its neutral value means that the effect is absent.
EffectSet effects_of(const Scene& scene);

/// Names of the effects present, in the order above: {"friction", "damping"}.
std::vector<std::string> effect_names(const EffectSet& effects);

struct EffectReason {
  std::string effect;
  bool present;
  std::string reason;  // "contact.restitution = 0.5", "every lot has the same diameter, mass and shape"
};
/// One line an effect, present or absent, for `check`.
std::vector<EffectReason> explain_effects(const Scene& scene);

}  // namespace vibrosow
