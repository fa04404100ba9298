#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "vessel/placed_face.hpp"
#include "vessel/placed_wall.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

/// All vessels' walls where they stand at one time, numbered like Box2D's shapes: vessel after vessel, in the order of
/// `vessel_walls`, or in 3D of `vessel_faces`.
class Walls {
 public:
  explicit Walls(std::vector<Vessel> vessels, Space space = Space::two_dimensional);
  Walls(const Walls&) = delete;
  Walls& operator=(const Walls&) = delete;

  /// Moves every wall to where it is at `time` (s), in a step whose middle was `lag` (s) ago.
  void place(double time, double lag = 0);

  /// A wall that is gone, as a gate that opened: it is placed no more.
  void remove(std::size_t wall) { about_[wall].removed = true; }
  void restore(std::size_t wall) { about_[wall].removed = false; }
  bool is_removed(std::size_t wall) const { return about_[wall].removed; }
  /// When a gate opens (s); 0: the wall is no gate.
  double opens_at(std::size_t wall) const { return about_[wall].opens_at; }
  std::size_t vessel_of(std::size_t wall) const { return about_[wall].vessel; }
  std::size_t count() const { return about_.size(); }

  const std::vector<PlacedWall>& placed() const { return placed_; }              // in 2D
  const std::vector<PlacedFace>& placed_faces() const { return placed_faces_; }  // in 3D
  const std::vector<Pose>& poses() const { return poses_; }                      // by vessel

  /// Another motion for a vessel from now on, its displacement moved by `shift` (m).
  void set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion, const Eigen::Vector2d& shift);
  Pose pose(std::size_t vessel, double time) const;
  PoseRate rate(std::size_t vessel, double time) const { return paths_[vessel].rate(time); }

  /// From a wall to a place in the lab, m2.
  double distance2(std::size_t wall, const Eigen::Vector3d& at) const;

  /// The walls of this name ("tray gate 1"): in a periodic vessel one in each of its copies.
  std::vector<std::size_t> named(const std::string& name) const;
  const std::vector<Vessel>& vessels() const { return vessels_; }

 private:
  struct About {
    std::size_t vessel;
    std::string name;
    double opens_at;  // s
    bool removed = false;
  };
  struct AtRest {
    Eigen::Vector2d a, b, centre;  // m, lab
    WallSegment own;               // in the vessel's frame
  };
  void add_segments(std::size_t vessel);
  void add_faces(std::size_t vessel);
  /// How a vessel is driven at a time.
  struct Driven {
    Pose pose;
    PoseRate rate;
  };
  Driven driven(std::size_t vessel, double time) const { return {pose(vessel, time), rate(vessel, time)}; }
  void place_segment(std::size_t wall, const Driven& now, const Driven& on_mean);
  void place_face(std::size_t wall, const Driven& now, const Driven& on_mean);
  void place_arc(PlacedWall& wall, const AtRest& rest, const Vessel& vessel, const Pose& pose) const;

  std::vector<Vessel> vessels_;
  std::vector<VesselPath> paths_;
  std::vector<Eigen::Vector2d> shifts_;  // m
  std::vector<About> about_;
  std::vector<AtRest> at_rest_;  // in 2D
  std::vector<Face> faces_;      // in 3D, in their vessel's frame
  std::vector<PlacedWall> placed_;
  std::vector<PlacedFace> placed_faces_;  // each points to its face
  std::vector<Pose> poses_;
};

}  // namespace vibrosow
