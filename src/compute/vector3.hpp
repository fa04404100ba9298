#pragma once

#include <cmath>

#include "compute/instruction_set.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Three numbers in the lab frame, for inner loops.
struct Vector3 {
  double x = 0, y = 0, z = 0;
};

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector3 operator*(double factor, const Vector3& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
inline double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector3& a) {
  return std::sqrt(dot(a, a));
}
/// Its part across the unit vector n.
inline Vector3 across(const Vector3& n, const Vector3& a) {
  return a - dot(n, a) * n;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
