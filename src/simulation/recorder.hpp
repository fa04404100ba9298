#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/state.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// The bed as it is now, without the arrays that say where grains were put in and what they fill. `vessel`: whose
/// motion it has as the tray's (0: the tray).
Snapshot snapshot_of(const Grains& grains, const Walls& walls, double time, std::size_t vessel = 0);

/// What grains of a scene's lots fill.
class GrainExtents {
 public:
  explicit GrainExtents(const std::vector<SeedLot>& lots);
  /// Sets a snapshot's areas, in 3D its volumes.
  void add_to(Snapshot& snapshot) const;

 private:
  std::vector<double> filled_;  // by lot, the grain's area over that of its circle; in 3D its volume over its ball's
};

/// Takes a snapshot at the first step that ends at or after each record time; a record at time 0 is the start. A scene
/// without a record has no recorder.
class Recorder {
 public:
  Recorder(const Scene& scene, RecorderState& state);

  /// Notes where grains put in since the last call are now: they are the last of `grains`.
  void note_new(const Grains& grains);

  bool is_due(double time) const;

  /// Appends a snapshot for each record time that has come.
  void record(const Grains& grains, const Walls& walls, double time, std::vector<Snapshot>& snapshots);

 private:
  Snapshot snapshot(const Grains& grains, const Walls& walls, double time) const;

  std::vector<double> times_;
  GrainExtents extents_;
  RecorderState& state_;
};

}  // namespace vibrosow
