#pragma once

#include <optional>

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Left against right of the tray's middle, (L - R) / (L + R), in [-1, 1]: 1 when all is on the left. L and R sum the
/// momentum towards the floor, m max(0, -v_y), of the grains inside the tray. None when nothing moves down. `own`: in
/// the tray's frame.
std::optional<double> flux_asymmetry(const Snapshot& own, const Vessel& tray);

/// The same of the free surface: L and R are the mean heights over the floor of columns about `cell` (m) wide, in 3D
/// also across, as many on each side; a column is as high as the top of its highest grain, 0 without one. None for an
/// empty tray.
std::optional<double> surface_asymmetry(const Snapshot& own, const Vessel& tray, double cell);

}  // namespace vibrosow
