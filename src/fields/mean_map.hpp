#pragma once

#include <vector>

#include "fields/grid.hpp"
#include "fields/map_part.hpp"
#include "fields/tray_frame.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Packing fraction and velocity by cell, in the mean over some looks at the bed, in the tray's frame.
struct MeanMap {
  Grid grid;
  std::vector<double> packing;  // mean share of the cell, as in packing_fraction
  std::vector<double> vx, vy;  // m/s, as in cell_motion, each look weighed by its packing; NaN of a cell without grains
  int looks = 0;
  double from = 0, to = 0;  // s, the first look and the last
};

/// Adds up looks.
class MeanMapSum {
 public:
  /// Of the tray's inside, in the cells and the view of the scene's [record].
  explicit MeanMapSum(const Scene& scene);

  /// `own`: the bed in the tray's frame, with what its grains fill.
  void add(const Snapshot& own);

  /// Without the rows above the highest that ever held a grain; of no looks no cells.
  MeanMap mean() const;

 private:
  std::vector<SeedLot> lots_;
  MapPart part_;
  Periods periods_;
  Grid grid_;
  std::vector<double> packing_, moved_x_, moved_y_;  // sums; of velocities times packing
  int looks_ = 0;
  double from_ = 0, to_ = 0;
};

}  // namespace vibrosow
