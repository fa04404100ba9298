#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contact/contact_force.hpp"
#include "contact/contact_list.hpp"
#include "contact/effects.hpp"
#include "grains/grains.hpp"

namespace vibrosow {

/// Everything the kernels know of a scene's contacts.
struct ContactParameters {
  SurfaceParameters seed, wall;
  double arm_shortening = 1;  // 1: friction acts at the contact point; 0: on the undeformed rim, as in paper A
};
ContactParameters contact_parameters(const Contact& contact);

/// Where and how fast the grains are when forces are wanted.
struct Motion {
  const double *x, *y, *vx, *vy, *omega;
};

struct Forces {
  std::vector<double> fx, fy;  // N
  std::vector<double> torque;  // N m; empty without rotation
};

/// What an evaluation of the forces tells besides the forces.
struct ContactCensus {
  std::int64_t contacts = 0;   // evaluations of the law
  double max_compression = 0;  // shell compression d c_j / (c_i + c_j) / r_i
  double wall_power = 0;       // W, work of moving walls on grains
  std::vector<int> crossed;    // grains whose centre went through a wall
};

/// Adds the forces of all touching pairs to `forces`. Neighbours of a grain are summed in the order of their indices.
using PairKernel = void (*)(const Grains&, const Motion&, const PairList&, const ContactParameters&, Forces&,
                            ContactCensus&);

/// Adds the forces of walls; `candidates` sorted by grain. A grain that touches a wall's face and an end point of the
/// same wall is pushed by the face alone, and once by an end point that two walls share. A candidate's side follows the
/// grain while it is beyond the wall's ends; a change of side beside the wall is a crossing.
using WallKernel = void (*)(const Grains&, const Motion&, std::vector<WallCandidate>&, const std::vector<PlacedWall>&,
                            const ContactParameters&, Forces&, ContactCensus&);

/// Elastic energy stored in all contacts, J.
using EnergyKernel = double (*)(const Grains&, const Motion&, const PairList&, const std::vector<WallCandidate>&,
                                const std::vector<PlacedWall>&);

/// One compiled combination of a law and the effects that enter the pair force.
struct KernelSet {
  Law law;
  bool friction, rotation, damping, unequal;
  PairKernel pair;
  WallKernel wall;
  EnergyKernel elastic_energy;
};

/// The registration table: every compiled combination.
const std::vector<KernelSet>& registered_kernels();

/// The kernels for just these effects (drag and motion do not matter here). Throws std::logic_error when not compiled.
const KernelSet& kernels_for(Law law, const EffectSet& effects);

/// The set in which every effect that enters the pair force is present.
EffectSet all_pair_effects();

}  // namespace vibrosow
