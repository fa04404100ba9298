#pragma once

#include "scene/contact_choices.hpp"

namespace vibrosow {

/// What a scene's contacts and motion call for. An effect that is absent costs nothing.
struct EffectSet {
  bool friction = false;
  bool rotation = false;  // only with friction, or of clumps
  bool damping = false;
  bool polydisperse = false;       // grains of more than one diameter, mass, shape or material
  bool drag = false;               // not part of the pair force: chosen in the integrator
  bool motion = false;             // a vessel moves: chosen in the loop
  bool tangential_spring = false;  // friction holds by a spring, and contacts have a history
  Rolling rolling = Rolling::none;
  bool cohesion = false;
  bool clumps = false;    // a grain is several discs: the kernels see discs
  bool periodic = false;  // pairs across the periodic boundary are a list of their own

  bool operator==(const EffectSet&) const = default;
};

}  // namespace vibrosow
