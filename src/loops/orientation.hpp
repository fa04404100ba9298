#pragma once

#include <cmath>

#include "compute/vector3.hpp"

namespace vibrosow {

/// How a clump lies in 3D: the unit quaternion of the rotation that takes its own axes to the lab's.
struct Orientation {
  double w = 1, x = 0, y = 0, z = 0;
  bool operator==(const Orientation&) const = default;
};

inline namespace VIBROSOW_ISA {

/// The rotation by b, then by a.
[[gnu::always_inline]] inline Orientation operator*(const Orientation& a, const Orientation& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

[[gnu::always_inline]] inline Orientation of_unit_length(const Orientation& q) {
  const double per = 1 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {per * q.w, per * q.x, per * q.y, per * q.z};
}

/// A clump's own axes in the lab: the columns of its rotation's matrix.
struct Axes {
  Vector3 x, y, z;
};

[[gnu::always_inline]] inline Axes axes_of(const Orientation& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
               wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)},
          {2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)},
          {2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)}};
}

/// A vector in the lab, of one along the clump's axes, and the other way round.
[[gnu::always_inline]] inline Vector3 in_lab(const Axes& axes, const Vector3& own) {
  return {axes.x.x * own.x + (axes.y.x * own.y + axes.z.x * own.z),
          axes.x.y * own.x + (axes.y.y * own.y + axes.z.y * own.z),
          axes.x.z * own.x + (axes.y.z * own.y + axes.z.z * own.z)};
}
[[gnu::always_inline]] inline Vector3 along(const Axes& axes, const Vector3& a) {
  return {axes.x.x * a.x + (axes.x.y * a.y + axes.x.z * a.z), axes.y.x * a.x + (axes.y.y * a.y + axes.y.z * a.z),
          axes.z.x * a.x + (axes.z.y * a.y + axes.z.z * a.z)};
}

}  // namespace VIBROSOW_ISA
}  // namespace vibrosow
