#pragma once

#include <vector>

#include "contact/kernels.hpp"
#include "grains/grains.hpp"
#include "simulation/neighbours.hpp"
#include "simulation/walls.hpp"

namespace vibrosow {

/// Contact forces on all grains at a time: walls are placed, neighbours brought up to date, the chosen kernels run.
class ForceField {
 public:
  ForceField(const Scene& scene, const KernelSet& kernels, NeighbourMargins margins);

  /// Forces on the grains where they are now, with the vessels where they are at `time`. Census figures are added up,
  /// but for the walls' power, which is this evaluation's.
  void evaluate(const Grains& grains, double time, ContactCensus& census);

  /// Takes a wall away at once; nothing touches it any more.
  void remove_wall(std::size_t wall);

  double elastic_energy(const Grains& grains) const;

  double neighbour_time() const { return neighbour_time_; }  // s of wall time spent so far
  double force_time() const { return force_time_; }

  const Forces& forces() const { return forces_; }
  const Walls& walls() const { return walls_; }
  Neighbours& neighbours() { return neighbours_; }
  const Neighbours& neighbours() const { return neighbours_; }

 private:
  Walls walls_;
  Neighbours neighbours_;
  ContactParameters parameters_;
  const KernelSet& kernels_;
  Forces forces_;
  double neighbour_time_ = 0, force_time_ = 0;
};

}  // namespace vibrosow
