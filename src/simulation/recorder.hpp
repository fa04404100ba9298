#pragma once

#include <Eigen/Core>
#include <vector>

#include "grains/grains.hpp"
#include "result/snapshot.hpp"

namespace vibrosow {

/// Takes a snapshot at the first step that ends at or after each record time; a record at time 0 is the start. A scene
/// without a record has no recorder.
class Recorder {
 public:
  explicit Recorder(const Scene& scene);

  /// Notes where grains put in since the last call are now: they are the last of `grains`.
  void note_new(const Grains& grains);

  bool is_due(double time) const;

  /// Appends a snapshot for each record time that has come.
  void record(const Grains& grains, double time, std::vector<Snapshot>& snapshots);

 private:
  Snapshot snapshot(const Grains& grains, double time) const;

  Vessel tray_;
  std::vector<double> times_;
  std::vector<double> filled_;  // by lot, the grain's area over that of its circle
  std::size_t taken_ = 0;
  std::vector<Eigen::Vector2d> start_;  // by id
};

}  // namespace vibrosow
