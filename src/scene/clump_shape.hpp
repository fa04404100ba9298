#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// A uniform plate in the shape of the union of discs; where they overlap, the plate is there once.
struct Plate {
  double area;             // m2
  Eigen::Vector2d centre;  // m, of mass
  double gyration2;        // m2, moment of inertia about the centre of mass over mass
};

/// Along the arcs of circles that no other disc covers, by Green's theorem: area = 1/2 integral(x dy - y dx),
/// integral of x = 1/2 integral(x^2 dy), of y = -1/2 integral(y^2 dx), of x^2 + y^2 = 1/3 integral(x^3 dy - y^3 dx).
/// Exact to rounding. The discs, at least one and of positive radius, may be apart, contain one another or be equal.
Plate plate_of(const std::vector<ClumpDisc>& discs);

/// Volume (m3) of the balls whose sections the discs are, all centres in one plane, overlaps counted once; of a row
/// parallel to x this is the body of revolution about its axis, in closed form; of others the integral over the height
/// z of the area that the discs of radius sqrt(r^2 - z^2) cover, to 1e-9 of itself. Of clumps in 3D:
/// `body_of_balls`.
double volume_of_balls(const std::vector<ClumpDisc>& discs);

/// The discs moved so that the centre of mass of their plate is the origin.
std::vector<ClumpDisc> about_centre_of_mass(std::vector<ClumpDisc> discs);

/// Radius (m) of the circle, in 3D the ball, about the origin that just holds all discs.
double holding_radius(const std::vector<ClumpDisc>& discs);

/// How a clump leans on a wall, at most over all its sides. Arms and radii in radii of gyration.
struct SideContacts {
  int discs = 1;  // that touch at once
  /// Stiffness over mass of the clump's fastest vibration against a wall, over that of one disc of weight 1 touched
  /// straight below the centre: touched at one disc, w (1 + a^2) with a its distance from the centre; and on a side the
  /// larger eigenvalue of [sum w, sum w a; sum w a, sum w a^2] in displacement and turn, of discs with arms a along it.
  double at_a_tip = 1, on_a_side = 1;
  double turning = 0;  // sum w r^2, of discs with radius r that hold it by friction
};

/// `discs` about their centre of mass, at least one, and as many `weights`: their stiffnesses over the largest;
/// `gyration2` in m2. A disc touches that the wall reaches when it presses the outermost in by `depth` (of its own
/// radius).
SideContacts side_contacts(const std::vector<ClumpDisc>& discs, const std::vector<double>& weights, double gyration2,
                           double depth);

/// How deep the outline of two discs on a line parallel to x dips below their common tangent, m; infinite when they
/// are apart, 0 when one holds the other.
double valley_depth(const ClumpDisc& a, const ClumpDisc& b);

/// Valleys that a rounded shape may have, as a fraction of its width, and the discs it may take.
inline constexpr double deepest_valley = 0.1;
inline constexpr int most_row_discs = 11;

/// A seed shaped as an ellipse, long axis along x, width < length (m): a row of discs that touch the ellipse from
/// within, the first and last at its ends. As few discs (3, 5, .. 11) as make every valley shallower than
/// `deepest_valley`: 3 to 1.6 widths, 5 to 2.4, 7 to 3.2, 9 to 4.2; empty when 11 are too few, beyond 5 widths.
std::vector<ClumpDisc> elongated(double length, double width);

/// A drop with its tip to the right, width < length (m): a disc of the width and smaller ones, in geometric order
/// between two common tangents, down to one of a quarter of it. 3 to 11 discs, chosen as in `elongated`; empty beyond
/// 3.9 widths.
std::vector<ClumpDisc> drop(double length, double width);

/// Balls that a flat seed may have side by side, and how many of its widths it is then thick at least.
inline constexpr int most_balls_across = 4;
inline constexpr double thinnest = 0.255;

/// The seeds that look like these from above, in 3D and `thickness` (m) thick along z, at most as thick as wide: the
/// row that has the length and the thickness, each ball of it as so many side by side along y that the seed is as wide
/// and no valley deeper than `deepest_valley` of the width. Where width and thickness differ by less than that, one
/// row of their geometric mean. Empty when too slender or too thin.
std::vector<ClumpDisc> elongated_solid(double length, double width, double thickness);
std::vector<ClumpDisc> drop_solid(double length, double width, double thickness);

/// Two equal discs (m, diameter and distance of the centres) on a massless rod.
std::vector<ClumpDisc> dipole(double diameter, double distance);

}  // namespace vibrosow
