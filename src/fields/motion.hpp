#pragma once

#include <optional>

#include "fields/gradient.hpp"
#include "fields/grid.hpp"
#include "fields/map_part.hpp"
#include "fields/tray_frame.hpp"

namespace vibrosow {

/// How the bed moves about the centre of a cell.
struct CellMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s; 0 across in 2D
  std::optional<Eigen::Matrix2d> gradient;             // 1/s; none where a fit is not possible
};

/// Radius of the neighbourhoods of fits, m: three mean diameters of the snapshot's grains.
double fit_reach(const Snapshot& snapshot);

/// Motion by cell: the mean velocity of grains within `reach` (m) of the cell's centre, weighted by mass and by Lucy's
/// kernel (1 + 3 q)(1 - q)^3 of q = distance / reach, and the gradient fitted through the same grains. None for a cell
/// without a grain in reach. In 3D of the grains in `part`, with distances and gradient in the plane of the map.
std::vector<std::optional<CellMotion>> cell_motion(const Snapshot& snapshot, const Grid& grid, double reach,
                                                   const MapPart& part = {});

/// Shear strain about each grain of `after` since `before`, from the displacement gradient (see `shear`) fitted through
/// the grains that were within `reach` (m) of it in `before` and are still there: what moved as a block has 0, a slip
/// line stands out. None for a grain that was not there before or has too few of its neighbours left. In 3D about
/// each grain in all directions. In a periodic tray a grain moved the shorter way
/// against each of its neighbours.
std::vector<std::optional<double>> shear_strain(const Snapshot& before, const Snapshot& after, double reach,
                                                const Periods& periods = {});

}  // namespace vibrosow
