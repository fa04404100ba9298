#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "result/snapshot.hpp"

namespace vibrosow {

/// Square cells in rows from below, each from the left. Edges lie at whole multiples of `cell` from the origin, so the
/// cells of two grids with the same edge coincide.
struct Grid {
  double cell = 0;                               // m, edge
  std::int64_t first_column = 0, first_row = 0;  // of the lower left cell
  std::int64_t columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns * rows); }
  std::size_t index(std::int64_t column, std::int64_t row) const {  // counted from the lower left cell
    return static_cast<std::size_t>(row * columns + column);
  }
  Eigen::Vector2d lower_left(std::size_t k) const {  // m, corner of a cell
    const auto place = static_cast<std::int64_t>(k);
    return cell * Eigen::Vector2d(static_cast<double>(first_column + place % columns),
                                  static_cast<double>(first_row + place / columns));
  }
  Eigen::Vector2d centre(std::size_t k) const { return lower_left(k) + Eigen::Vector2d::Constant(0.5 * cell); }
};

/// How many cells of an edge (m) it takes to cover a length (m).
std::int64_t cells_over(double length, double cell);

/// The smallest grid that covers every grain of the snapshots; of no cells without grains. `cell` > 0, m.
Grid grid_over(const std::vector<const Snapshot*>& snapshots, double cell);

}  // namespace vibrosow
