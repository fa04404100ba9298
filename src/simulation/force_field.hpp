#pragma once

#include <optional>
#include <vector>

#include "compute/execution.hpp"
#include "contact/pair_forces.hpp"
#include "contact/wall_contacts.hpp"
#include "grains/clump_discs.hpp"
#include "grains/grains.hpp"
#include "simulation/neighbours.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Contact forces on all grains at a time: walls are placed, neighbours brought up to date, the chosen kernels run.
/// Where grains are clumps, lists and kernels see their discs, and the forces are gathered.
class ForceField {
 public:
  ForceField(const Scene& scene, const EffectSet& effects, NeighbourMargins margins, Execution& execution);
  ForceField(const ForceField&) = delete;
  ForceField& operator=(const ForceField&) = delete;

  /// Forces on the grains where they are now, with the vessels where they are at `time`. Statistics figures are added
  /// up, but for the walls' power, which is this evaluation's. `advance` moves the memory of contacts on.
  void evaluate(const Grains& grains, double time, const HistoryAdvance& advance, ContactStatistics& statistics);

  /// Energy of all springs in contacts, J.
  double elastic_energy(const Grains& grains);

  /// Forces of the walls alone on each grain, where grains and walls are now; nothing moves on by it.
  Forces wall_forces(const Grains& grains);

  /// Which grains touch another one.
  std::vector<char> touching(const Grains& grains) const;

  /// Grains were put in: the next evaluation looks for neighbours afresh.
  void grains_added();
  /// These grains (one flag each) are being taken out.
  void remove_flagged(const std::vector<char>& removed);
  /// Takes a wall away at once; nothing touches it any more.
  void remove_wall(std::size_t wall);

  const Forces& forces() const { return forces_; }
  const Walls& walls() const { return walls_; }
  Neighbours& neighbours() { return neighbours_; }
  const Neighbours& neighbours() const { return neighbours_; }

 private:
  const Grains& place_discs(const Grains& grains);
  void set_pair_forces(const Grains& discs, const Motion& at, const HistoryAdvance& advance, Forces& forces,
                       ContactStatistics& statistics);
  Motion motion_of(const Grains& discs) const;
  Motion across_boundary(const Grains& discs);
  void add_wall_forces(const Grains& discs, const Motion& at, const HistoryAdvance& advance, Forces& forces,
                       ContactStatistics& statistics);
  void run_kernels(const Grains& discs, const HistoryAdvance& advance, Forces& forces, ContactStatistics& statistics);

  const Scene& scene_;
  Execution& execution_;
  Walls walls_;
  Neighbours neighbours_;
  ContactParameters parameters_;
  const KernelSet& kernels_;
  PairKernel pair_kernel_;
  WallKernel wall_kernel_;
  WallContactFinder wall_finder_;
  WallContacts wall_contacts_;
  std::optional<ClumpDiscs> clumps_;
  bool clumps_are_current_ = false;
  Forces forces_, disc_forces_;

  /// What one thread's range of pairs leaves for the others.
  struct RangeResult {
    std::vector<ForeignForce> foreign;
    ContactStatistics statistics;
  };
  std::vector<RangeResult> range_results_;
  std::vector<double> shifted_x_;  // m, of periodic sides
};

}  // namespace vibrosow
