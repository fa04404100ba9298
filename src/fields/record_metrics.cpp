#include "fields/record_metrics.hpp"

#include "fields/packing_fraction.hpp"
#include "fields/segregation.hpp"
#include "fields/tray_frame.hpp"

namespace vibrosow {

std::vector<RecordMetrics> record_metrics(const Scene& scene, const std::vector<Snapshot>& snapshots) {
  std::vector<RecordMetrics> records;
  for (const Snapshot& snapshot : snapshots) {
    const Snapshot own = in_tray_frame(snapshot, scene.tray);
    RecordMetrics metrics{bed_packing(own, scene.lots, scene.tray, scene.record->cell), {}};
    for (int lot = 0; lot < static_cast<int>(scene.lots.size()); ++lot)
      metrics.segregation.push_back(segregation_index(own, scene.tray, lot));
    records.push_back(std::move(metrics));
  }
  return records;
}

}  // namespace vibrosow
