#pragma once

#include <cmath>

namespace vibrosow {

/// A distance along a periodic direction less as many periods as leave the least of it. What std::remainder gives,
/// which takes some hundred times as long.
inline double nearest_image(double apart, double period) {
  const double size = std::abs(apart);
  if (size <= 0.5 * period) return apart;
  if (size < 1.5 * period) return apart > 0 ? apart - period : apart + period;
  return std::remainder(apart, period);
}

/// A place along a periodic direction, counted from where the period begins, less as many periods as bring it into one.
inline double within_period(double place, double period) {
  return place - period * std::floor(place / period);
}

}  // namespace vibrosow
