#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// A piece of a vessel's wall: a straight line from a to b, or where the radius is not zero an arc, anticlockwise from
/// a to b.
struct WallSegment {
  Eigen::Vector2d a, b;   // m, in the vessel's own frame
  std::string name;       // "tray left wall", "tray floor 2", "hopper floor 1 falling", "tray piece 3", "tray gate 1"
  bool is_piece = false;  // of Vessel::pieces
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // m, of an arc
  double radius = 0;                                 // m, of an arc
  double from = 0, to = 0;                           // rad, of an arc
  double opens_at = 0;                               // s, of a gate: when it vanishes; 0: it stays
};

/// The walls of a vessel in its own frame: its box, its pieces, its gates.
///
/// The box runs from the vessel's upper left to its upper right corner: left end wall, floor pieces between the holes,
/// right end wall. With a funnel the floor falls to each hole's edges at y = 0 from the end walls and from a ridge
/// midway between two neighbouring holes' edges; a funnel without holes is a flat floor. Every segment of the box runs
/// left to right along the chain, so the inside of the vessel lies to its left. Pieces shorter than 1e-9 of the
/// vessel's length are left out: a hole may reach the end wall. Open sides: no end walls. Periodic sides: no end walls,
/// and everything is there three times, shifted by the length to either side, which leaves room for grains that are
/// beyond a side and not yet carried over to the other.
///
/// A gate lies across each hole that opens later than 0. A piece turned about an axis, or drawn out along the vessel,
/// is a wall of space alone.
std::vector<WallSegment> vessel_walls(const Vessel& vessel);

/// Whether a piece is a line or an arc of the plane, in 3D drawn out from front to back.
bool is_of_plane(const WallPiece& piece);

/// The rectangle in which pieces lie, m, in their vessel's frame; in 3D seen from the front, or from the left those
/// that are drawn out along it.
struct Extent {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = Eigen::Vector2d::Constant(-1e300);

  /// Of its longer side.
  double size() const { return (high - low).maxCoeff(); }
};
Extent extent(const std::vector<WallPiece>& pieces);

/// Height of the floor, in m, at its highest point: 0 when flat.
double highest_floor(const Vessel& vessel);

/// Distance, in m, of the furthest wall from the point `about` of the vessel's frame (of arcs: an upper bound).
double largest_radius(const Vessel& vessel, const Eigen::Vector2d& about);

/// The circle that closes a drum, m.
struct DrumCircle {
  Eigen::Vector2d centre;
  double radius;

  /// Whether an arc of this centre and radius (m) lies on it.
  bool has(const Eigen::Vector2d& centre_of_arc, double radius_of_arc) const;
};

/// The circle that a vessel without floor and end walls is closed by all round, all its other pieces lying within it:
/// drawn as one, as arcs that close, or more than once. Of circles that lie on each other the smallest.
std::optional<DrumCircle> drum_of(const Vessel& vessel);

/// Whether the vessel has neither floor and end walls nor is a drum: its room is what lies between its pieces.
bool is_only_drawn(const Vessel& vessel);

/// Distance, in m, of a point of the vessel's frame from a wall.
double distance_to_wall(const WallSegment& wall, const Eigen::Vector2d& point);

}  // namespace vibrosow
