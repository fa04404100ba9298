#pragma once

#include <optional>
#include <vector>

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What is left of a snapshot where maps are not wanted.
struct RecordMetrics {
  std::optional<double> packing;                   // bed_packing with a margin of one cell of the record
  std::vector<std::optional<double>> segregation;  // segregation_index by lot
};

/// Of each snapshot of a run of `scene`, which has a record.
std::vector<RecordMetrics> record_metrics(const Scene& scene, const std::vector<Snapshot>& snapshots);

}  // namespace vibrosow
