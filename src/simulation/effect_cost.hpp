#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

struct EffectCost {
  std::string effect;        // "all effects present", or an effect's name
  double ns_per_grain_step;  // of the whole, or what the effect adds to it
};

/// Times a small bed of its own on this machine, with the scene's law, scheme and effects and with each effect left out
/// in turn, together with those that need it. Takes a second; the figures depend on the machine and the moment, so they
/// belong on a terminal and in no result.
std::vector<EffectCost> effect_costs(const Scene& scene);

}  // namespace vibrosow
