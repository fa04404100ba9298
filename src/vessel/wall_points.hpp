#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/scene.hpp"
#include "vessel/bounding_box.hpp"
#include "vessel/face.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

// Walls as those see them who draw them, m, in the vessel's own frame.

/// The ends of a straight wall, of an arc points every 4 degrees or closer.
std::vector<Eigen::Vector2d> wall_points(const WallSegment& wall);

/// Lines that show a face: its edges and its holes' rims; of a surface of revolution its two rims and eight lines
/// between them.
std::vector<std::vector<Eigen::Vector3d>> face_lines(const Face& face);

/// The walls of a vessel as they are seen from the front: those of the plane, each once, and of pieces that are drawn
/// out along the vessel the edges, lines at the heights of their ends and of arcs' lowest and highest places.
std::vector<WallSegment> walls_from_the_front(const Vessel& vessel);

/// How far all of a vessel's walls reach, by such points: an arc a thousandth of its radius further at most.
BoundingBox reach_of(const Vessel& vessel, Space space);

/// The vessel without the copies of its walls that a periodic one has beside it.
Vessel drawn_once(Vessel vessel);

}  // namespace vibrosow
