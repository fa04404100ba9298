#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "vessel/face.hpp"

namespace vibrosow {

/// All faces of a vessel in 3D, in its own frame: floor, end walls, front and back, then its pieces from front to
/// back, those along it, those turned about axes, the discs that close a drum in front and behind, then the walls of
/// its round holes in a thick floor, and its gates. The floor is a plate with round holes, or plates between slots; a
/// floor that slopes towards slots as long as the vessel is deep is a wedge. Throws std::invalid_argument where a floor
/// slopes towards other holes, or round holes and slots are mixed.
std::vector<Face> vessel_faces(const Vessel& vessel);

/// Distance, in m, of the furthest face from the upright axis through x and z of the vessel's frame (of surfaces of
/// revolution: an upper bound).
double largest_radius_in_plan(const Vessel& vessel, const Eigen::Vector2d& about);

}  // namespace vibrosow
