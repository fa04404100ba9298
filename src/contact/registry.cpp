#include <stdexcept>

#include "contact/elastic_shell.hpp"
#include "contact/kernels.hpp"
#include "contact/pair_kernel.hpp"
#include "contact/restitution.hpp"
#include "contact/wall_kernel.hpp"

namespace vibrosow {
namespace {

template <class LawType, class Effects>
KernelSet kernel_set(Law law) {
  return {law,
          Effects::friction,
          Effects::rotation,
          Effects::damping,
          Effects::unequal,
          pair_forces<LawType, Effects>,
          wall_forces<LawType, Effects>,
          elastic_energy<LawType>};
}

/// All combinations of effects for one law: 12 kernels.
template <class LawType>
void register_law(Law law, std::vector<KernelSet>& table) {
  const auto with = [&]<bool damping, bool unequal>() {
    table.push_back(kernel_set<LawType, PairEffects<false, false, damping, unequal>>(law));
    table.push_back(kernel_set<LawType, PairEffects<true, false, damping, unequal>>(law));
    table.push_back(kernel_set<LawType, PairEffects<true, true, damping, unequal>>(law));
  };
  with.template operator()<false, false>();
  with.template operator()<false, true>();
  with.template operator()<true, false>();
  with.template operator()<true, true>();
}

std::vector<KernelSet> build_table() {
  std::vector<KernelSet> table;
  register_law<ElasticShell>(Law::elastic_shell, table);
  return table;
}

}  // namespace

const std::vector<KernelSet>& registered_kernels() {
  static const std::vector<KernelSet> table = build_table();
  return table;
}

const KernelSet& kernels_for(Law law, const EffectSet& effects) {
  for (const KernelSet& set : registered_kernels())
    if (set.law == law && set.friction == effects.friction && set.rotation == effects.rotation &&
        set.damping == effects.damping && set.unequal == effects.unequal)
      return set;
  throw std::logic_error("no kernel is compiled for this set of effects");
}

EffectSet all_pair_effects() {
  return {.friction = true, .rotation = true, .damping = true, .unequal = true, .drag = false, .motion = false};
}

ContactParameters contact_parameters(const Contact& contact) {
  const auto surface = [&contact](const Surface& s) {
    return SurfaceParameters{s.friction, 1 / contact.slip_speed, linear_damping_ratio(s.restitution)};
  };
  return {surface(contact.seed), surface(contact.wall), contact.friction_arm == FrictionArm::contact_point ? 1.0 : 0.0};
}

}  // namespace vibrosow
