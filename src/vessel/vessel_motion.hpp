#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>

#include "scene/scene.hpp"
#include "vessel/pose.hpp"

namespace vibrosow {

/// A vessel's motion, ready to be asked often. Times in s.
///
/// harmonic: the frame moves by A s(t) sin(2 pi f t + phase) along a direction. sum: the sum of such. rocking: it turns
/// by Theta s(t) sin(2 pi f t) about a pivot that stays where it is at rest. table: positions and angle are
/// interpolated between the times by piecewise cubics with continuous first derivatives (modified Akima), at rest
/// before the first and after the last. turning: about its axis by the integral of omega s(t). s grows as 3 p^2 - 2 p^3
/// during the ramp, p its elapsed part, and from `stop` falls to zero likewise; then the vessel stands still.
class VesselPath {
 public:
  explicit VesselPath(const Vessel& vessel);

  Pose pose(double time) const;
  /// The time derivative of the pose.
  PoseRate rate(double time) const;

  struct Curves;  // through a table's points

 private:
  double tilt_;
  std::optional<VesselMotion> motion_;
  std::shared_ptr<const Curves> curves_;
};

/// Where the path of a table goes furthest beyond both of the rows between which it is.
struct Overshoot {
  std::string_view column = {};  // "x_mm"
  double share = 0;              // of all that the column's rows go through; 0: it is nowhere beyond
  double from = 0, to = 0;       // s, of the two rows
};
Overshoot largest_overshoot(const TableMotion& table);

/// The same for one time.
Pose vessel_pose(const Vessel& vessel, double time);
PoseRate vessel_velocity(const Vessel& vessel, double time);

/// A point of the vessel's own frame in the lab, and the inverse. Frames in m.
Eigen::Vector2d in_lab_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& own);
Eigen::Vector2d in_vessel_frame(const Vessel& vessel, const Pose& pose, const Eigen::Vector2d& lab);

/// The same in 3D, and a direction.
Eigen::Vector3d point_in_lab(const Vessel& vessel, const Pose& pose, const Eigen::Vector3d& own);
Eigen::Vector3d direction_in_lab(const Vessel& vessel, const Pose& pose, const Eigen::Vector3d& own);
Eigen::Vector3d point_in_vessel(const Vessel& vessel, const Pose& pose, const Eigen::Vector3d& lab);

/// Velocity (m/s, lab) of the vessel's material at the point `lab` (m).
Eigen::Vector2d material_velocity(const Vessel& vessel, const Pose& pose, const PoseRate& rate,
                                  const Eigen::Vector2d& lab);

/// The same in 3D, and how the vessel turns, rad/s, lab.
Eigen::Vector3d point_velocity(const Vessel& vessel, const Pose& pose, const PoseRate& rate,
                               const Eigen::Vector3d& lab);
Eigen::Vector3d spin_3d(const Vessel& vessel, const Pose& pose, const PoseRate& rate);

/// The pose by which rain falls and maps are drawn: the vessel's, or where it turns steadily that at rest.
Pose steady_frame(const Vessel& vessel, const Pose& pose);

/// Whether its floor is no steeper than 60 degree, so that seeds lie on it and fall in from above.
bool stands(const Vessel& vessel, const Pose& pose);

/// Of a vessel that turns over and over about the axis across, or that a table tips over so far that it does not
/// stand: a level frame whose line y = 0 lies below all that the vessel reaches.
std::optional<Pose> line_below(const Vessel& vessel);

/// By how much (m, in the vessel's frame, along and across) what rises straight up in the lab moves aside while it
/// rises by `rise` (m) at right angles to the floor of a vessel that stands; level: 0.
Eigen::Vector3d aside_while_rising(const Vessel& vessel, const Pose& pose, double rise);

/// Bounds for any point of the vessel's walls, without the ramps' fraction; 0 without motion. A harmonic has 2 pi f A
/// and (2 pi f)^2 A, a sum the sum of these, rocking the same with Theta times the furthest wall's distance R from the
/// pivot for A (its centripetal fraction is never the larger one below 1 rad), turning omega R and omega^2 R. A table
/// is sampled between its times; there an angle's rate counts with R from the frame's zero. How far they get aside from
/// where they are at rest is A's level part, Theta R, 2 R of what turns steadily, and of a table sampled likewise.
struct MotionBounds {
  double speed = 0;                  // m/s
  double acceleration = 0;           // m/s2
  double vertical_acceleration = 0;  // m/s2
  double displacement = 0;           // m, level
  double angle = 0;                  // rad, about the axis across
};
MotionBounds motion_bounds(const Vessel& vessel);

}  // namespace vibrosow
