#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "compute/instruction_set.hpp"
#include "contact/contact_list.hpp"
#include "grains/grains.hpp"
#include "scene/scene.hpp"
#include "vessel/pose.hpp"

namespace vibrosow {

/// How a search is shared: `for_each(work)` calls work(range) for each range 0 .. count - 1, perhaps several at once.
struct Ranges {
  int count;
  std::function<void(const std::function<void(int)>&)> for_each;
};

/// From where on a grain is near: m, by grain. Its radius, and more if its list is to last while it moves.
struct Reaches {
  std::vector<double> pair, wall;
};
/// The radii alone.
Reaches reaches_at_rest(const Grains& grains);

/// Box2D's part: it holds the vessels' walls as shapes of bodies (the tray kinematic, the hopper static), keeps a tree
/// of the boxes of clusters of eight neighbouring grains, and says which grains may touch what. Its solver never runs,
/// and it never says how deep a contact is. The only place where lengths become float: one Box2D unit is the largest
/// grain's diameter, because Box2D's margins are compiled in for shapes of about one unit.
class Broadphase {
 public:
  /// The vessels' walls are numbered in order, vessel after vessel. `unit` in m is the length of one Box2D unit.
  Broadphase(const std::vector<Vessel>& vessels, double unit, InstructionSet instructions);
  ~Broadphase();

  /// Fills `pairs` with all (i, j) whose centres are nearer than their reaches plus margin (m) and `near_walls` with at
  /// least all grains nearer than theirs plus margin to a wall, both sorted; the candidates' sides are not set. `poses`
  /// of each vessel; coordinates are taken relative to the first vessel's displacement, so that a bed moving with its
  /// tray stays in its boxes.
  void find(const Grains& grains, const std::vector<Pose>& poses, const Reaches& reaches, double margin,
            const Ranges& ranges, PairList& pairs, std::vector<WallCandidate>& near_walls);

  /// Fills `pairs` with all (i, j) such that i, shifted by `period` (m) to the right, is nearer than their reaches plus
  /// margin to j: pairs across the periodic boundary; j may be less than i. For the grains and poses of the last
  /// `find`.
  void find_across(double period, double margin, const Ranges& ranges, PairList& pairs);

  /// Takes wall `wall` out of the vessel's body: nothing will touch it any more.
  void remove_wall(int wall);
  /// Puts it back.
  void restore_wall(int wall);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace vibrosow
