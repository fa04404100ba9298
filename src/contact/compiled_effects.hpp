#pragma once

#include <array>
#include <cstddef>

#include "scene/contact_choices.hpp"

namespace vibrosow {

enum class FrictionChoice { none, sliding, spring };

/// Effects that enter the contact force. Rotation needs friction, rolling needs rotation.
struct EffectChoice {
  FrictionChoice friction = FrictionChoice::none;
  bool rotation = false, damping = false, polydisperse = false;
  Rolling rolling = Rolling::none;
  bool cohesion = false;

  bool operator==(const EffectChoice&) const = default;
};

/// Every combination that is compiled for each law: 20 plain ones, 10 with cohesion and 16 with rolling resistance;
/// those two always with damping, which bounds what there is to build.
constexpr auto list_compiled_effects() {
  using enum FrictionChoice;
  std::array<EffectChoice, 46> list{};
  std::size_t count = 0;
  for (const bool polydisperse : {false, true}) {
    for (int kind = 0; kind < 3; ++kind) {
      const bool damping = kind > 0, cohesion = kind > 1;
      list[count++] = {none, false, damping, polydisperse, Rolling::none, cohesion};
      for (const FrictionChoice friction : {sliding, spring})
        for (const bool rotation : {false, true})
          list[count++] = {friction, rotation, damping, polydisperse, Rolling::none, cohesion};
    }
    for (const bool cohesion : {false, true})
      for (const FrictionChoice friction : {sliding, spring})
        for (const Rolling rolling : {Rolling::constant_torque, Rolling::spring})
          list[count++] = {friction, true, true, polydisperse, rolling, cohesion};
  }
  return list;
}
inline constexpr auto compiled_effects = list_compiled_effects();

/// A choice of effects as a type, for code that is compiled for just these.
template <EffectChoice choice>
struct PairEffects {
  static constexpr bool friction = choice.friction != FrictionChoice::none;
  static constexpr bool spring = choice.friction == FrictionChoice::spring;
  static constexpr bool rotation = choice.rotation, damping = choice.damping, polydisperse = choice.polydisperse;
  static constexpr Rolling rolling = choice.rolling;
  static constexpr bool rolls = choice.rolling != Rolling::none;
  static constexpr bool cohesion = choice.cohesion;
};

}  // namespace vibrosow
