#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "vessel/placed_wall.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

/// All vessels' walls where they stand at one time, numbered like Box2D's shapes: vessel after vessel, in the order of
/// `vessel_walls`.
class Walls {
 public:
  explicit Walls(std::vector<Vessel> vessels);

  /// Moves every wall to where it is at `time` (s).
  void place(double time);

  /// A wall that is gone, as a gate that opened: it is placed no more.
  void remove(std::size_t wall) { at_rest_[wall].removed = true; }
  void restore(std::size_t wall) { at_rest_[wall].removed = false; }
  bool is_removed(std::size_t wall) const { return at_rest_[wall].removed; }
  /// When a gate opens (s); 0: the wall is no gate.
  double opens_at(std::size_t wall) const { return at_rest_[wall].own.opens_at; }

  const std::vector<PlacedWall>& placed() const { return placed_; }
  const std::vector<Pose>& poses() const { return poses_; }  // by vessel

  /// Another motion for a vessel from now on, its displacement moved by `shift` (m).
  void set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion, const Eigen::Vector2d& shift);
  Pose pose(std::size_t vessel, double time) const;
  PoseRate rate(std::size_t vessel, double time) const { return paths_[vessel].rate(time); }

  /// The wall of this name ("tray gate 1"), where there is one.
  std::optional<std::size_t> find(const std::string& name) const;
  const std::vector<Vessel>& vessels() const { return vessels_; }

 private:
  struct AtRest {
    Eigen::Vector2d a, b, centre;  // m, lab
    WallSegment own;               // in the vessel's frame
    std::size_t vessel;
    bool removed = false;
  };
  void place_arc(PlacedWall& wall, const AtRest& rest, const Pose& pose) const;

  std::vector<Vessel> vessels_;
  std::vector<VesselPath> paths_;
  std::vector<Eigen::Vector2d> shifts_;  // m
  std::vector<AtRest> at_rest_;
  std::vector<PlacedWall> placed_;
  std::vector<Pose> poses_;
};

}  // namespace vibrosow
