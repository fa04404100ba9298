#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contact/effect_set.hpp"
#include "contact/energy_kernels.hpp"
#include "contact/pair_block.hpp"
#include "grains/grains.hpp"

namespace vibrosow {

/// What an evaluation of the forces tells besides the forces.
struct ContactStatistics {
  std::int64_t contacts = 0;        // evaluations of the law
  std::int64_t slip_raised = 0;     // of these with a slip speed raised
  double max_relative_overlap = 0;  // overlap c_i / (c_i + c_j) / r_i, compliances c
  double wall_power = 0;            // W, work of moving walls on grains
  std::vector<int> crossed;         // grains whose centre went through a wall
};

/// What pair kernels need to know of the grains.
GrainSurfaces surfaces_of(const Grains& grains);

/// One compiled combination of a law and the effects that enter the pair force.
struct KernelSet {
  Law law;
  EffectChoice effects;
  std::array<VectorKernels, instruction_sets.size()> vectors;  // null where this program was built without
  EnergyKernel energy;
  // The same of balls in 3D.
  std::array<VectorKernels3d, instruction_sets.size()> vectors_3d;
  EnergyKernel3d energy_3d;
};

/// The registration table: every compiled combination.
const std::vector<KernelSet>& registered_kernels();

/// The kernels for just these effects (drag, motion, clumps and periodic sides do not matter here). Scenes with rolling
/// resistance or cohesion run a kernel that has damping too, at its neutral value where there is none. Throws
/// std::logic_error when not compiled.
const KernelSet& kernels_for(Law law, const EffectSet& effects);

/// The set in which every effect that enters the pair force is present, beside `effects`: its kinds of friction and of
/// rolling resistance stay.
EffectSet all_pair_effects(EffectSet effects);

}  // namespace vibrosow
