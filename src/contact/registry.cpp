#include <stdexcept>

#include "contact/elastic_shell.hpp"
#include "contact/hertz.hpp"
#include "contact/kernels.hpp"
#include "contact/pair_kernel.hpp"
#include "contact/restitution.hpp"
#include "contact/wall_kernel.hpp"

namespace vibrosow {
namespace {

using Table = std::vector<KernelSet>;

template <class LawType, FrictionChoice friction, bool rotation, bool damping, bool unequal, Rolling rolling,
          bool cohesion>
void add(Law law, Table& table) {
  using Effects = PairEffects<friction, rotation, damping, unequal, rolling, cohesion>;
  table.push_back({law, friction, rotation, damping, unequal, rolling, cohesion, pair_forces<LawType, Effects>,
                   wall_forces<LawType, Effects>, pair_energy<LawType, Effects>, wall_energy<LawType, Effects>});
}

template <class LawType, bool damping, bool unequal, bool cohesion>
void add_frictions(Law law, Table& table) {
  using enum FrictionChoice;
  add<LawType, none, false, damping, unequal, Rolling::none, cohesion>(law, table);
  add<LawType, sliding, false, damping, unequal, Rolling::none, cohesion>(law, table);
  add<LawType, sliding, true, damping, unequal, Rolling::none, cohesion>(law, table);
  add<LawType, spring, false, damping, unequal, Rolling::none, cohesion>(law, table);
  add<LawType, spring, true, damping, unequal, Rolling::none, cohesion>(law, table);
}

template <class LawType, bool unequal, bool cohesion>
void add_rolling(Law law, Table& table) {
  using enum FrictionChoice;
  add<LawType, sliding, true, true, unequal, Rolling::constant_torque, cohesion>(law, table);
  add<LawType, spring, true, true, unequal, Rolling::constant_torque, cohesion>(law, table);
  add<LawType, sliding, true, true, unequal, Rolling::spring, cohesion>(law, table);
  add<LawType, spring, true, true, unequal, Rolling::spring, cohesion>(law, table);
}

/// All combinations of effects for one law: 20 plain ones, 10 with cohesion and 16 with rolling resistance; those two
/// always with damping, which bounds what there is to build.
template <class LawType>
void register_law(Law law, Table& table) {
  add_frictions<LawType, false, false, false>(law, table);
  add_frictions<LawType, false, true, false>(law, table);
  add_frictions<LawType, true, false, false>(law, table);
  add_frictions<LawType, true, true, false>(law, table);
  add_frictions<LawType, true, false, true>(law, table);
  add_frictions<LawType, true, true, true>(law, table);
  add_rolling<LawType, false, false>(law, table);
  add_rolling<LawType, false, true>(law, table);
  add_rolling<LawType, true, false>(law, table);
  add_rolling<LawType, true, true>(law, table);
}

Table build_table() {
  Table table;
  register_law<ElasticShell>(Law::elastic_shell, table);
  register_law<Hertz>(Law::hertz, table);
  register_law<HertzViscous>(Law::hertz_viscous, table);
  return table;
}

}  // namespace

const std::vector<KernelSet>& registered_kernels() {
  static const Table table = build_table();
  return table;
}

const KernelSet& kernels_for(Law law, const EffectSet& effects) {
  const FrictionChoice friction = !effects.friction           ? FrictionChoice::none
                                  : effects.tangential_spring ? FrictionChoice::spring
                                                              : FrictionChoice::sliding;
  const bool rotation = effects.rotation && effects.friction;  // without friction no contact turns a disc
  const bool damping = effects.damping || effects.cohesion || effects.rolling != Rolling::none;
  for (const KernelSet& set : registered_kernels())
    if (set.law == law && set.friction == friction && set.rotation == rotation && set.damping == damping &&
        set.unequal == effects.unequal && set.rolling == effects.rolling && set.cohesion == effects.cohesion)
      return set;
  throw std::logic_error("no kernel is compiled for this set of effects");
}

EffectSet all_pair_effects(EffectSet effects) {
  effects.friction = effects.rotation = effects.damping = effects.unequal = effects.cohesion = true;
  if (effects.rolling == Rolling::none) effects.rolling = Rolling::constant_torque;
  return effects;
}

}  // namespace vibrosow
