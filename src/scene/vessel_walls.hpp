#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// A straight piece of a vessel's wall. Segments that meet share a vertex number.
struct WallSegment {
  Eigen::Vector2d a, b;  // m, in the vessel's own frame
  int vertex_a, vertex_b;
  std::string name;  // "tray left wall", "tray floor 2", "hopper floor 1 falling"
};

/// The walls of a vessel in its own frame, from its upper left to its upper right corner: left end wall,
/// floor pieces between the holes, right end wall. With a funnel the floor falls to each hole's edges at y =
/// 0 from the end walls and from a ridge midway between two neighbouring holes' edges; a funnel without holes
/// is a flat floor. Every segment runs left to right along the chain, so the inside of the vessel lies to its
/// left. Pieces shorter than 1e-9 of the vessel's length are left out: a hole may reach the end wall.
std::vector<WallSegment> vessel_walls(const Vessel& vessel);

/// Height of the floor, in m, at its highest point: 0 when flat.
double highest_floor(const Vessel& vessel);

/// Distance, in m, of the wall point that lies furthest from the point `about` of the vessel's frame.
double largest_radius(const Vessel& vessel, const Eigen::Vector2d& about);

}  // namespace vibrosow
