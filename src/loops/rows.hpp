#pragma once

#include <cstddef>

#include "compute/four.hpp"
#include "loops/grain_force.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Vectors of which x, y and z lie apart, side by side. `row(i)` is where the i-th goes.
template <class Row>
[[gnu::always_inline]] inline void to_rows(std::size_t n, const double* x, const double* y, const double* z, Row row) {
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Four rows[4]{};
    load(rows[0], x + i), load(rows[1], y + i), load(rows[2], z + i);
    transpose(rows);
    for (std::size_t k = 0; k < 4; ++k) *reinterpret_cast<Four*>(row(i + k)) = rows[k];
  }
  for (; i < n; ++i) *row(i) = {x[i], y[i], z[i], 0};
}

}  // namespace vibrosow::inline VIBROSOW_ISA
