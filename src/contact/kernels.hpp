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
  std::size_t lots = 1;
  std::vector<SurfaceParameters> pairs;  // lots x lots, symmetric
  std::vector<SurfaceParameters> walls;  // by lot
  double wall_compliance = 0;            // as a grain's; 0: rigid
  double arm_shortening = 1;  // 1: friction acts at the contact point; 0: on the undeformed rim, as in paper A

  const SurfaceParameters& pair(int lot_i, int lot_j) const {
    return pairs[static_cast<std::size_t>(lot_i) * lots + static_cast<std::size_t>(lot_j)];
  }
  const SurfaceParameters& wall(int lot) const { return walls[static_cast<std::size_t>(lot)]; }
};
ContactParameters contact_parameters(const Scene& scene);

/// The surface between two lots, or of a lot and the walls (`other` = -1).
const Surface& surface_between(const Contact& contact, int lot, int other);

/// Where and how fast the grains are when forces are wanted. `row_x` stands for `x` of the first grain of each pair: it
/// is the same array, or shifted by one period for pairs across the seam of periodic sides.
struct Motion {
  const double *x, *y, *vx, *vy, *omega, *row_x;
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
/// `history` has an entry for each pair of the list.
using PairKernel = void (*)(const Grains&, const Motion&, const PairList&, const ContactParameters&,
                            const HistoryAdvance&, ContactHistory& history, Forces&, ContactCensus&);

/// Adds the forces of walls; `candidates` sorted by grain. A grain that touches a wall's face and an end point of the
/// same wall is pushed by the face alone, and once by an end point that two walls share. A candidate's side follows the
/// grain while it is beyond the wall's ends; a change of side beside the wall is a crossing.
using WallKernel = void (*)(const Grains&, const Motion&, std::vector<WallCandidate>&, const std::vector<PlacedWall>&,
                            const ContactParameters&, const HistoryAdvance&, ContactHistory& history, Forces&,
                            ContactCensus&);

/// Energy stored in all contacts of pairs, or of walls, J.
using PairEnergyKernel = double (*)(const Grains&, const Motion&, const PairList&, const ContactParameters&,
                                    const ContactHistory&);
using WallEnergyKernel = double (*)(const Grains&, const Motion&, const std::vector<WallCandidate>&,
                                    const std::vector<PlacedWall>&, const ContactParameters&, const ContactHistory&);

/// One compiled combination of a law and the effects that enter the pair force.
struct KernelSet {
  Law law;
  FrictionChoice friction;
  bool rotation, damping, unequal;
  Rolling rolling;
  bool cohesion;
  PairKernel pair;
  WallKernel wall;
  PairEnergyKernel pair_energy;
  WallEnergyKernel wall_energy;
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
