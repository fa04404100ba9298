#pragma once

#include <Eigen/Core>
#include <cmath>

namespace vibrosow {

/// How a clump lies in space: the unit quaternion of the rotation that takes its own axes to the lab's.
struct Orientation {
  double w = 1, x = 0, y = 0, z = 0;
  bool operator==(const Orientation&) const = default;
};

/// How a clump is turned: by an angle (rad) in the plane, as it lies in space.
struct Turn {
  double angle = 0;
  Orientation orientation{};
};

/// The rotation by b, then by a.
inline Orientation operator*(const Orientation& a, const Orientation& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

inline Orientation of_unit_length(const Orientation& q) {
  const double per = 1 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {per * q.w, per * q.x, per * q.y, per * q.z};
}

/// Its columns are the clump's axes in the lab.
inline Eigen::Matrix3d rotation_matrix(const Orientation& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
               wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return Eigen::Matrix3d{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
                         {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
                         {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}};
}

}  // namespace vibrosow
