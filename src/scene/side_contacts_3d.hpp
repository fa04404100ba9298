#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/clump_shape.hpp"

namespace vibrosow {

/// `side_contacts` in 3D: `balls` from their centre of mass along the principal axes, `gyration2` (m2) about these.
/// Pushed at c by a unit force along n, a clump yields at c by 1 + (c x n) G^-1 (c x n) over its mass, G = gyration2:
/// at a tip by at most 1 plus the larger eigenvalue of [c]^T G^-1 [c]. On a side it is the largest eigenvalue of sum w
/// v v^T, v = (1, G^-1/2 (c x n)). All sides are looked at: planes that touch three balls, and for pairs planes at
/// every sixteenth of a turn about them. `turning` counts the least of G, and a tip at its furthest point as well.
SideContacts side_contacts_3d(const std::vector<ClumpDisc>& balls, const std::vector<double>& weights,
                              const Eigen::Vector3d& gyration2, double depth);

/// The largest (p x t) G^-1 (p x t) of a point p of a ball's surface and a unit vector t, from above: (a + r /
/// sqrt(g))^2 with a^2 the larger eigenvalue of [c]^T G^-1 [c] and g the least of G. Of a clump, of its ball where it
/// is largest.
double furthest_yield(const std::vector<ClumpDisc>& balls, const Eigen::Vector3d& gyration2);

}  // namespace vibrosow
