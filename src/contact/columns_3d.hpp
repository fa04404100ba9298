#pragma once

#include "compute/four.hpp"
#include "compute/vector3.hpp"
#include "contact/data_3d.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// A vector of each contact of a block.
struct Columns3d {
  alignas(64) double x[pair_block_room], y[pair_block_room], z[pair_block_room];

  [[gnu::always_inline]] Vector3 operator[](int k) const { return {x[k], y[k], z[k]}; }
  [[gnu::always_inline]] void set(int k, const Vector3& a) { x[k] = a.x, y[k] = a.y, z[k] = a.z; }
};

inline const Four& as_four(const GrainVector& vector) {
  return reinterpret_cast<const Four&>(vector);
}

/// Sets the vectors of the first `count` contacts, each by `set_row(k, row)`, and up to the next multiple of four.
template <class SetRow>
[[gnu::always_inline]] inline void fetch(int count, Columns3d& columns, SetRow set_row) {
  for (int k = 0; k < count; k += 4) {
    Four rows[4];
    for (int n = 0; n < 4; ++n) set_row(k + n < count ? k + n : count - 1, rows[n]);
    transpose(rows);
    *reinterpret_cast<Four*>(columns.x + k) = rows[0];
    *reinterpret_cast<Four*>(columns.y + k) = rows[1];
    *reinterpret_cast<Four*>(columns.z + k) = rows[2];
  }
}

}  // namespace vibrosow::inline VIBROSOW_ISA
