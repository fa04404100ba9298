#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fields/grid.hpp"
#include "fields/map_part.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Area (m2) that a disc of `radius` about the origin has in common with the rectangle from `low` to `high` (m). In
/// closed form: the disc's part left of and below a corner (a, b) inside the circle is
/// a b + (a sqrt(1 - a^2) + b sqrt(1 - b^2) + asin a + asin b) / 2 + pi / 4 for radius 1, and the rectangle is made of
/// four such parts.
double disc_in_rectangle(double radius, const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// Volume (m3) that a ball of `radius` about the origin has in common with the box from `low` to `high` (m), which may
/// be infinite. In closed form, as above: the box is made of eight parts of the ball left of, below and before a
/// corner.
double ball_in_box(double radius, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// A disc of the bed; in 3D a ball.
struct CoveringDisc {
  double x, y, radius;  // m
  double fraction;      // of its area or volume that counts
  double z = 0;         // m, in 3D
};

/// All discs of the grains, in 3D all balls. A clump's discs count with the same fraction each, so that together
/// they have the clump's area (volume), overlaps counted once: exact for the whole clump, even over it where a line
/// cuts it. `lots`: the scene's.
std::vector<CoveringDisc> covering_discs(const Snapshot& snapshot, const std::vector<SeedLot>& lots);

/// Share of each cell's area that grains cover, exact for discs; where two grains overlap their common area counts
/// twice. The whole cell counts, also where a wall cuts it. Grains outside the grid are left out. In 3D the share of
/// the cell's volume, which is as deep as `part`, exact for balls.
std::vector<double> packing_fraction(const Snapshot& snapshot, const std::vector<SeedLot>& lots, const Grid& grid,
                                     const MapPart& part = {});

/// Packing fraction of the bed's inside, as above, of one rectangle: the middle half of the tray's length, from
/// `margin` (m) over the floor to the height under which the centres of three quarters of the grains' area lie, and in
/// space of a box, the middle half of its depth. What the surface and the walls do to the packing is left out; a crater
/// that reaches so deep counts as empty. None for a bed that is too low for it. Of the grains inside the tray. `own`:
/// in the tray's frame.
std::optional<double> bed_packing(const Snapshot& own, const std::vector<SeedLot>& lots, const Vessel& tray,
                                  double margin);

/// Packing fraction of `after` minus that of `before`, cell by cell: below 0 the bed has loosened, above 0 compacted.
std::vector<double> packing_change(const Snapshot& before, const Snapshot& after, const std::vector<SeedLot>& lots,
                                   const Grid& grid, const MapPart& part = {});

}  // namespace vibrosow
