#pragma once

#include "scene/scene.hpp"

namespace vibrosow {

/// Area of a vessel's floor in space, m2, holes included. The vessel has a depth.
double floor_area(const Vessel& vessel);

/// How many slices one seed thick a tray holds: its depth over the seeds' mean thickness, by number; none without a
/// depth.
std::optional<double> slices_of_tray(const Scene& scene);

/// The slice of a scene in space that the plane simulates: seeds and rain in its share, each row of holes as slots from
/// front to back, round vessels cut through their middle, clumps as their sections across z. A scene of the plane stays
/// as it is.
Scene in_plane(Scene scene);

/// The scene in space whose slice a scene of the plane is: as many slices of seeds as the depth takes, slots from front
/// to back, clumps of the balls with their discs as sections. Throws InputError without `tray.depth`; a hopper without
/// one is as deep as the tray. A scene in space stays as it is.
Scene in_space(Scene scene);

}  // namespace vibrosow
