#include "fields/mean_map.hpp"

#include <algorithm>
#include <limits>

#include "fields/motion.hpp"
#include "fields/packing_fraction.hpp"

namespace vibrosow {
namespace {

Grid grid_of(const Vessel& tray, double cell) {
  Grid grid;
  grid.cell = cell;
  grid.columns = cells_over(tray.length, cell);
  grid.rows = cells_over(tray.height, cell);
  return grid;
}

}  // namespace

MeanMapSum::MeanMapSum(const Scene& scene)
    : lots_(scene.lots),
      part_(map_part(scene)),
      periods_(periods_of(scene.tray, scene.space != Space::two_dimensional)),
      grid_(grid_of(scene.tray, scene.record->cell)),
      packing_(grid_.size(), 0.0),
      moved_x_(packing_),
      moved_y_(packing_) {}

void MeanMapSum::add(const Snapshot& own) {
  const double reach = std::max(fit_reach(own), grid_.cell);
  const Snapshot bed = with_images(own, periods_, reach + grid_.cell);
  const std::vector<double> packing = packing_fraction(bed, lots_, grid_, part_);
  const auto motion = cell_motion(bed, grid_, reach, part_);
  for (std::size_t k = 0; k < packing.size(); ++k) {
    packing_[k] += packing[k];
    if (!motion[k]) continue;
    moved_x_[k] += packing[k] * motion[k]->velocity.x(), moved_y_[k] += packing[k] * motion[k]->velocity.y();
  }
  if (looks_++ == 0) from_ = own.time;
  to_ = own.time;
}

MeanMap MeanMapSum::mean() const {
  MeanMap map{grid_, {}, {}, {}, looks_, from_, to_};
  std::size_t end = packing_.size();
  while (end > 0 && packing_[end - 1] == 0) --end;
  map.grid.rows = (static_cast<std::int64_t>(end) + grid_.columns - 1) / grid_.columns;
  for (std::size_t k = 0; k < map.grid.size(); ++k) {
    const double held = packing_[k], none = std::numeric_limits<double>::quiet_NaN();
    map.packing.push_back(held / looks_);
    map.vx.push_back(held > 0 ? moved_x_[k] / held : none), map.vy.push_back(held > 0 ? moved_y_[k] / held : none);
  }
  return map;
}

}  // namespace vibrosow
