#pragma once

namespace vibrosow {

/// A wall where it stands now, in the lab frame: a straight segment from a to b, or with a radius an arc from a to b.
struct PlacedWall {
  double ax, ay, bx, by;  // m
  double vx, vy;          // m/s; its material at the point (x, y) of the lab moves at (vx - spin y, vy + spin x)
  double spin = 0;        // rad/s, anticlockwise
  // Of an arc: its centre and radius, the direction from the centre to its middle, the cosine of half its angle.
  double centre_x = 0, centre_y = 0, radius = 0;  // m
  double middle_x = 0, middle_y = 0, cos_half = 0;
};

}  // namespace vibrosow
