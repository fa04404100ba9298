#pragma once

namespace vibrosow {

/// A wall where it stands now, in the lab frame: a straight segment from a to b, or with a radius an arc from a to b.
struct PlacedWall {
  double ax, ay, bx, by;  // m
  /// How its material moves: at (x, y) at (vx - spin y, vy + spin x), m/s and rad/s, anticlockwise.
  struct Moving {
    double vx = 0, vy = 0, spin = 0;
  };
  Moving now, on_mean;  // when it stands here, and on the mean over the step that brought it here
  // Of an arc: its centre and radius, the direction from the centre to its middle, the cosine of half its angle.
  double centre_x = 0, centre_y = 0, radius = 0;  // m
  double middle_x = 0, middle_y = 0, cos_half = 0;
};

}  // namespace vibrosow
