#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "plan/step_plan.hpp"

namespace vibrosow {

/// A disc of a seed, in 3D a ball, as contacts see it, and where it lies from the seed's centre of mass, m.
struct BedDisc {
  GrainKind kind;
  Eigen::Vector3d arm;
};

/// A seed of a packed bed as it lies.
struct BedSeed {
  int lot;
  double size;  // over the lot's diameter
  GrainKind kind;
  std::array<Eigen::Vector3d, 3> axes;  // principal ones, in the order of `kind.moments`
  std::vector<BedDisc> discs;
};

/// Where two discs of different seeds touch, or one a plate.
struct BedContact {
  static constexpr int plate = -1;

  int a, b;            // seeds
  int disc_a, disc_b;  // of these
  Eigen::Vector3d normal;
};

/// A few of a scene's seeds, pressed together.
struct PackedBed {
  std::vector<BedSeed> seeds;
  std::vector<BedContact> contacts;
};

/// Seeds of all lots, their sizes and how they are turned drawn at random, pressed without friction between two plates
/// until contacts are some hundredth of a diameter deep; along the plates the bed is periodic. So they have as many
/// contacts as seeds ever have that lie anyhow: without friction some six in 3D and four in 2D are needed to
/// hold, and those that the depth adds. The same scene has the same bed. In 2D every z is 0. The beds of the seeds that
/// were asked for last are kept, since layouts of a study mostly differ in other things; safe from several threads.
PackedBed packed_bed(const StepBasis& basis);

}  // namespace vibrosow
