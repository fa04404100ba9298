#pragma once

#include <cstddef>

namespace vibrosow {

/// Parts of 1 of red, green and blue.
struct Colour {
  double red, green, blue;
};

inline constexpr Colour paper{1, 1, 1}, ink{0.13, 0.15, 0.17}, force_red{0.80, 0.10, 0.12};

/// `share` of a, the rest b.
constexpr Colour mixed(const Colour& a, const Colour& b, double share) {
  const double rest = 1 - share;
  return {share * a.red + rest * b.red, share * a.green + rest * b.green, share * a.blue + rest * b.blue};
}

/// Of a scene's lots, told apart by people who see few colours (Okabe and Ito 2008); from the eighth on again.
Colour lot_colour(std::size_t lot);

/// From 0, dark, to 1, light (viridis); beyond these the end's.
Colour ramp_colour(double share);

}  // namespace vibrosow
