#pragma once

#include <vector>

#include "grains/grains.hpp"
#include "loops/execution.hpp"
#include "loops/forces_3d.hpp"
#include "loops/grain_force.hpp"

namespace vibrosow {

/// A disc of a clump, in 3D a ball, as a contact sees it: with its clump's whole mass and moment of inertia. `clump`
/// is the whole seed, `size` its size over its lot's.
GrainKind kind_of_disc(const GrainKind& clump, const ClumpDisc& disc, double size, const LawTraits& law);

/// The discs of rigid clumps, in 3D balls: what the contact kernels and lists see when a grain is several of them. A
/// grain of a lot that is a single disc is a clump of one. Each disc bears its clump's whole mass and moment of inertia
/// in a contact; its shell is eps = shell_compression times its own radius thick under that weight.
class ClumpDiscs {
 public:
  /// `kinds`: a seed of each lot's diameter.
  ClumpDiscs(const std::vector<SeedLot>& lots, const std::vector<GrainKind>& kinds, const LawTraits& law,
             bool rotation);

  /// Makes the discs anew for these clumps.
  void rebuild(const Grains& clumps);
  /// Moves the discs with their clumps: x + R c, v + omega x R c, R by the clump's angle or quaternion.
  void place(const Grains& clumps, Execution& execution);
  /// Force and torque about the centres of mass, from those on the discs about their own centres.
  void gather(const Forces& on_discs, Forces& on_clumps) const;
  /// The same in 3D, in place of what `on_clumps` held. Without friction the balls have no torques, and the clumps
  /// those of the forces' arms.
  void gather(const Forces3d& on_balls, Forces3d& on_clumps, Execution& execution) const;

  /// In 3D their velocities and spins stand in `motions` alone.
  const Grains& discs() const { return discs_; }
  /// Of balls in 3D.
  const std::vector<GrainVector>& places() const { return places_; }
  const std::vector<BallMotion>& motions() const { return motions_; }
  /// One flag a disc, from one a clump.
  std::vector<char> flags_of_discs(const std::vector<char>& of_clumps) const;

 private:
  const std::vector<SeedLot>& lots_;
  const LawTraits& law_;
  std::int64_t discs_per_id_;  // numbers kept free for the discs of a clump
  Grains discs_;
  void place_in_plane(const Grains& clumps);
  void place_3d(const Grains& clumps, Execution& execution);

  std::vector<double> own_x_, own_y_, own_z_;  // m, from the centre of mass, clump not turned
  std::vector<double> arm_x_, arm_y_;          // m, the same as it lies now, in 2D
  std::vector<GrainVector> arms_, places_;     // m, in 3D
  std::vector<BallMotion> motions_;
  std::vector<std::size_t> first_;  // of each clump's discs; behind the last clump, how many there are
};

}  // namespace vibrosow
