#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "compute/instruction_set.hpp"
#include "contact/compiled_effects.hpp"
#include "contact/contact_history.hpp"
#include "contact/contact_list.hpp"
#include "laws/surface_parameters.hpp"
#include "loops/grain_force.hpp"

// Plain data between the simulation and kernels compiled for several instruction sets.

namespace vibrosow {

/// Everything the kernels know of a scene's contacts.
struct ContactParameters {
  std::size_t lots = 1;
  std::vector<SurfaceParameters> pairs;  // lots x lots, symmetric
  std::vector<SurfaceParameters> walls;  // by lot
  double wall_compliance = 0;            // as a grain's; 0: rigid
  double arm_shortening = 1;  // 1: friction acts at the contact point; 0: on the undeformed rim, as in paper A
  /// No slope of sliding friction by the sliding speed, nor of a constant rolling torque by the speed of turning, is
  /// larger than this times the mass, or the moment of inertia, of the two that meet, 1/s.
  double steepest_sliding = std::numeric_limits<double>::infinity();
  double steepest_rolling = std::numeric_limits<double>::infinity();

  const SurfaceParameters& pair(int lot_i, int lot_j) const {
    return pairs[static_cast<std::size_t>(lot_i) * lots + static_cast<std::size_t>(lot_j)];
  }
  const SurfaceParameters& wall(int lot) const { return walls[static_cast<std::size_t>(lot)]; }
};
/// What a contact needs to know of one grain.
struct GrainSurface {
  double radius, compliance, inverse_mass, inverse_inertia, curvature;
  double lever_yield;  // 1/kg, GrainKind's
};

/// The same of all grains: arrays where they are polydisperse, `equal` where they are not.
struct GrainSurfaces {
  GrainSurface equal;
  const double *radius, *compliance, *inverse_mass, *inverse_inertia, *curvature, *lever_yield;
  const int* lot;
};

/// Where and how fast the grains are when forces are wanted. `row_x` stands for `x` of the first grain of each pair: it
/// is the same array, or shifted by one period for pairs across the periodic boundary.
struct Motion {
  const double *x, *y, *vx, *vy, *omega, *row_x;
};

/// Entries [from, to) of a pair list, at most pair_block_size of them.
struct PairRange {
  int from, to;
};
/// Of these one in three to seven touches: so many that what the last vector works out for nothing counts little.
inline constexpr int pair_block_size = 1024;
/// Numbers in a column of a block: a cache line more, or all columns would compete for the same few lines.
inline constexpr int pair_block_room = pair_block_size + 8;

/// Of the contacts that were worked out.
struct LawMetrics {
  double max_relative_overlap = 0;
  double slip_raised = 0;  // how many had a slip speed raised
};

/// Where the forces of a block of pairs go: to their grains, but for grains before `first_own`, whose forces are listed
/// in the order of the pairs.
struct PairResult {
  GrainForce* forces;
  int first_own;

  int contacts;
  LawMetrics metrics;
  int foreign_count;
  ForeignForce foreign[pair_block_size];
};

/// Works out a block: the law for each touching pair of a range, contact by contact added to the grains in the order of
/// the list. `histories` has an entry for each pair of the list.
using PairKernel = void (*)(const GrainSurfaces&, const Motion&, const PairList&, PairRange, const ContactParameters&,
                            const ContactStep&, ContactHistories& histories, PairResult&);

/// Grains that touch walls: of each array the first `count` places count.
struct WallContacts {
  int count = 0;
  std::vector<int> candidate, grain;
  std::vector<double> dx, dy, distance2;            // m, m2: from the centre to the wall's nearest point
  std::vector<double> normal_x, normal_y;           // towards the wall, set where the distance is 0
  std::vector<double> wall_vx, wall_vy, wall_spin;  // m/s, rad/s: of the wall's material there; the spin on the mean
  std::vector<double> mean_wall_vx, mean_wall_vy;   // m/s, on the step's mean
  std::vector<double> fx, fy, torque;               // N, on the wall; N m, on the grain, without rotation unset
};

/// Works out the forces of all contacts. `histories` has an entry for each candidate.
using WallKernel = LawMetrics (*)(const GrainSurfaces&, const Motion&, const ContactParameters&, const ContactStep&,
                                  ContactHistories& histories, WallContacts&);

/// What is compiled for each instruction set.
struct VectorKernels {
  PairKernel pair;
  WallKernel wall;
};

/// By index of `compiled_effects`.
using LawKernels = std::array<VectorKernels, compiled_effects.size()>;

}  // namespace vibrosow
