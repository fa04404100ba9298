#pragma once

#include <memory>
#include <vector>

#include "box2d/broadphase.hpp"
#include "compute/instruction_set.hpp"
#include "contact/contact_list.hpp"
#include "grains/grains.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Box2D's part in 3D: it keeps the ground plan, x and z. Balls are sorted into slabs of some two diameters by their
/// height, within a slab into clusters of eight neighbours; the slabs' plans lie side by side in one tree, so that a
/// query meets a cluster only where its slab is near too. Faces are shapes of bodies in the plan; heights are compared
/// after.
class Broadphase3d {
 public:
  /// `unit` in m is the length of one Box2D unit.
  Broadphase3d(const std::vector<Vessel>& vessels, double unit, InstructionSet instructions);
  ~Broadphase3d();

  /// Fills `pairs` with all (i, j) whose centres are nearer than their reaches plus margin (m) and `near_walls` with at
  /// least all balls nearer than theirs plus margin to a face, both sorted; the candidates' sides are not set. `poses`
  /// of each vessel.
  void find(const Grains& grains, const std::vector<Pose>& poses, const Reaches& reaches, double margin,
            const Ranges& ranges, PairList& pairs, std::vector<WallCandidate>& near_walls);

  /// Fills `pairs` with all (i, j) such that i, moved by (shift_x, shift_z) (m), is nearer than their reaches plus
  /// margin to j: pairs across a periodic boundary; j may be less than i. For the balls and poses of the last `find`.
  void find_across(double shift_x, double shift_z, double margin, const Ranges& ranges, PairList& pairs);

  /// Takes a face out of the vessel's body: nothing will touch it any more.
  void remove_wall(int wall);
  /// Puts it back.
  void restore_wall(int wall);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace vibrosow
