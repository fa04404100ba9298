#pragma once

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The snapshot in the tray's own frame: positions from the left end of its floor, x along the floor, in space z from
/// its front; velocities and spins relative to the tray's. Starts are taken as if the tray had been at rest then. The
/// tray itself is at rest. Of a tray that turns over and over it
/// is the frame of the tray at rest.
Snapshot in_tray_frame(const Snapshot& lab, const Vessel& tray);

/// Indices of the grains between the tray's end walls, above its floor line and below their tops, and in space between
/// its front and back. `own`: in the tray's
/// frame.
std::vector<std::size_t> grains_in_tray(const Snapshot& own, const Vessel& tray);

}  // namespace vibrosow
