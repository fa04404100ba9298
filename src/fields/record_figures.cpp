#include "fields/record_figures.hpp"

#include "fields/packing_fraction.hpp"
#include "fields/segregation.hpp"
#include "fields/tray_frame.hpp"

namespace vibrosow {

std::vector<RecordFigures> record_figures(const Scene& scene, const std::vector<Snapshot>& snapshots) {
  std::vector<RecordFigures> records;
  for (const Snapshot& snapshot : snapshots) {
    const Snapshot own = in_tray_frame(snapshot, scene.tray);
    RecordFigures figures{bed_packing(own, scene.lots, scene.tray, scene.record->cell), {}};
    for (int lot = 0; lot < static_cast<int>(scene.lots.size()); ++lot)
      figures.segregation.push_back(segregation_index(own, scene.tray, lot));
    records.push_back(std::move(figures));
  }
  return records;
}

}  // namespace vibrosow
