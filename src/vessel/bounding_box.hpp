#pragma once

#include <Eigen/Core>

namespace vibrosow {

/// The box along the axes that holds points; none yet: low beyond high. m.
struct BoundingBox {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;

  void include(const Eigen::Vector3d& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
  /// m, to another box; 0 where they overlap.
  double gap(const BoundingBox& other) const {
    return (low - other.high).cwiseMax(other.low - high).cwiseMax(Eigen::Vector3d::Zero()).norm();
  }
  /// One of the eight, 0 to 7.
  Eigen::Vector3d corner(int k) const {
    return {(k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z()};
  }
};

}  // namespace vibrosow
