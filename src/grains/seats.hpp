#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "scene/scene.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

/// How wide the places of a fill in rows are.
struct SeatWidth {
  double clear;  // m, so wide that jitter never makes an overlap
  double shift;  // m, of jitter along each direction, each way

  SeatWidth(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space);
};

/// Visits the places (m, in the vessel's frame) of a fill in rows, those of one row in 2D, of one layer in
/// space, from below, until `visit` is false; what no seed can lie in is left out. Whether `visit` ever was: otherwise
/// the next row would rise above the vessel's walls, or a row has a single place. The vessel has a fill, `layers` or
/// `hexagonal`.
bool visit_seats(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space,
                 const std::function<bool(const Eigen::Vector3d&)>& visit);

/// Whether a grain of `radius` (m) at `seat` does not lie within a drum, if there is one.
bool is_outside_of_drum(const std::optional<DrumCircle>& drum, const Eigen::Vector2d& seat, double radius);

}  // namespace vibrosow
