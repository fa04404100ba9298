#include <stdexcept>

#include "compute/each_instruction_set.hpp"
#include "contact/energy_kernels.hpp"
#include "contact/kernels.hpp"

namespace vibrosow {

// Defined in law_kernels.cpp and law_kernels_3d.cpp, compiled for each.
VIBROSOW_DECLARE_IN_EACH_SET(template <Law law> const LawKernels& law_kernels();
                             template <Law law> const LawKernels3d& law_kernels_3d();)

template <Law law>
const EnergyKernels& energy_kernels();  // law_energies.cpp, compiled for each law
template <Law law>
const EnergyKernels3d& energy_kernels_3d();  // law_energies_3d.cpp, as well

namespace {

using Table = std::vector<KernelSet>;

#ifdef VIBROSOW_PLANE_ALONE  // of a program that simulates nothing in 3D, and is to be small
template <Law>
void add_space([[maybe_unused]] KernelSet& set, [[maybe_unused]] std::size_t index) {}
#else
template <Law law>
void add_space(KernelSet& set, std::size_t index) {
  set.energy_3d = energy_kernels_3d<law>()[index];
  set.vectors_3d = VIBROSOW_OF_EACH_SET(, law_kernels_3d<law>()[index]);
}
#endif

template <Law law>
void add_law(Table& table) {
  const EnergyKernels& energies = energy_kernels<law>();
  for (std::size_t index = 0; index < compiled_effects.size(); ++index) {
    KernelSet set{law, compiled_effects[index], VIBROSOW_OF_EACH_SET(, law_kernels<law>()[index]), energies[index], {},
                  {}};
    add_space<law>(set, index);
    table.push_back(set);
  }
}

Table build_table() {
  Table table;
#define VIBROSOW_ADD(name) add_law<Law::name>(table);
  VIBROSOW_LAWS(VIBROSOW_ADD)
#undef VIBROSOW_ADD
  return table;
}

}  // namespace

const std::vector<KernelSet>& registered_kernels() {
  static const Table table = build_table();
  return table;
}

GrainSurfaces surfaces_of(const Grains& grains) {
  const GrainKind& kind = grains.kinds.front();
  return {{kind.radius, kind.compliance, kind.inverse_mass, kind.inverse_inertia, 1 / kind.radius, kind.lever_yield},
          grains.radius.data(),
          grains.compliance.data(),
          grains.inverse_mass.data(),
          grains.inverse_inertia.data(),
          grains.curvature.data(),
          grains.lever_yield.data(),
          grains.lot.data()};
}

const KernelSet& kernels_for(Law law, const EffectSet& effects) {
  EffectChoice wanted;
  wanted.friction = !effects.friction           ? FrictionChoice::none
                    : effects.tangential_spring ? FrictionChoice::spring
                                                : FrictionChoice::sliding;
  wanted.rotation = effects.rotation && effects.friction;  // without friction no contact turns a disc
  wanted.damping = effects.damping || effects.cohesion || effects.rolling != Rolling::none;
  wanted.polydisperse = effects.polydisperse;
  wanted.rolling = effects.rolling;
  wanted.cohesion = effects.cohesion;
  for (const KernelSet& set : registered_kernels())
    if (set.law == law && set.effects == wanted) return set;
  throw std::logic_error("no kernel is compiled for this set of effects");
}

EffectSet all_pair_effects(EffectSet effects) {
  effects.friction = effects.rotation = effects.damping = effects.polydisperse = effects.cohesion = true;
  if (effects.rolling == Rolling::none) effects.rolling = Rolling::constant_torque;
  return effects;
}

}  // namespace vibrosow
