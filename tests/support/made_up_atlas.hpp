#pragma once

#include <vector>

#include "calibration/repose_band.hpp"

namespace vibrosow {

/// An atlas of the functions that are given, of friction, rolling friction and aspect ratio, on a grid of 0.1 to 1, 0
/// to 0.3 and 1 to 2; each point of 4 runs that scatter by the given deviations.
template <class Angle, class Packing>
ReposeAtlas made_up_atlas(Angle angle, Packing packing, double angle_scatter = 0.02, double packing_scatter = 0.004) {
  std::vector<AtlasPoint> points;
  for (const double aspect : {1.0, 1.5, 2.0})
    for (int f = 1; f <= 10; ++f)
      for (int r = 0; r <= 6; ++r) {
        AtlasPoint point{aspect, 0.1 * f, 0.05 * r, 4, 0, {}, {}, {0.7, 0.02}};
        point.angle = {angle(aspect, point.friction, point.rolling_friction), angle_scatter};
        point.packing = {packing(aspect, point.friction, point.rolling_friction), packing_scatter};
        points.push_back(point);
      }
  return ReposeAtlas(points);
}

/// Heaps steeper by friction and by rolling friction, beds looser by friction alone; in 3D 0.05 rad flatter, and of
/// 0.7 of the packing fraction.
inline ShippedAtlas plain_atlas() {
  return {made_up_atlas([](double aspect, double f, double r) { return 0.25 + 0.3 * f + 0.5 * r + 0.1 * (aspect - 1); },
                        [](double, double f, double) { return 0.86 - 0.08 * f; }),
          {{-0.05, 0.01}, {0.7, 0.007}, {0.9, 0.05}, 4}};
}

}  // namespace vibrosow
