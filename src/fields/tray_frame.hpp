#pragma once

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Lengths after which a tray repeats itself, m; 0: it does not.
struct Periods {
  double along = 0, across = 0;
};
Periods periods_of(const Vessel& tray, bool is_3d);

/// The snapshot in the tray's own frame: positions from the left end of its floor, x along the floor, in 3D z from
/// its front; velocities and spins relative to the tray's. Starts are taken as if the tray had been at rest then. The
/// tray itself is at rest. Of a tray that turns over and over it is the frame of the tray at rest. In a periodic tray
/// each grain is where its image lies within the tray: in the lab one may be up to a diameter beyond the seam.
Snapshot in_tray_frame(const Snapshot& lab, const Vessel& tray);

/// The same bed and, after its grains, their images in the neighbouring periods that come within `reach` (m) of the
/// tray, under the same ids: what a map needs at its edges. `own`: in the tray's frame.
Snapshot with_images(const Snapshot& own, const Periods& periods, double reach);

/// The same moment with some of its grains alone. `grains`: their indices, ascending.
Snapshot part_of(const Snapshot& bed, const std::vector<std::size_t>& grains);

/// Indices of the grains in the tray, as the snapshot knows them; of one that does not, of those between the tray's end
/// walls, above its floor line and below their tops, and in 3D between its front and back. `own`: in the tray's frame.
std::vector<std::size_t> grains_in_tray(const Snapshot& own, const Vessel& tray);

}  // namespace vibrosow
