#pragma once

#include <Eigen/Core>

#include "vessel/placed_face.hpp"

namespace vibrosow {

/// The nearest point of a face to a grain's centre.
struct NearestOnFace {
  Eigen::Vector3d apart;  // m, lab, from the centre to the point
  double distance2;       // m2
  bool inside;            // whether it lies inside the face, not on its edge or a hole's rim
  double side;            // its sign tells the side: where a plate's normal points, right of the line that was revolved
};

/// `centre` in m, lab.
NearestOnFace nearest_on_face(const PlacedFace& face, const Eigen::Vector3d& centre);

/// The normal (unit, lab) of the face at a point of it, towards the side whose sign is positive.
Eigen::Vector3d face_normal_at(const PlacedFace& face, const Eigen::Vector3d& point);

}  // namespace vibrosow
