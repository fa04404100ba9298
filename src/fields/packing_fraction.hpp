#pragma once

#include <Eigen/Core>
#include <vector>

#include "fields/grid.hpp"

namespace vibrosow {

/// Area (m2) that a disc of `radius` about the origin has in common with the rectangle from `low` to `high` (m). In
/// closed form: the disc's part left of and below a corner (a, b) inside the circle is
/// a b + (a sqrt(1 - a^2) + b sqrt(1 - b^2) + asin a + asin b) / 2 + pi / 4 for radius 1, and the rectangle is made of
/// four such parts.
double disc_in_rectangle(double radius, const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// Share of each cell's area that grains cover, exact for discs; where two overlap their common area counts twice. The
/// whole cell counts, also where a wall cuts it. Grains outside the grid are left out.
std::vector<double> packing_fraction(const Snapshot& snapshot, const Grid& grid);

/// Packing fraction of `after` minus that of `before`, cell by cell: below 0 the bed has loosened, above 0 compacted.
std::vector<double> packing_change(const Snapshot& before, const Snapshot& after, const Grid& grid);

}  // namespace vibrosow
