#pragma once

#include <cmath>
#include <numbers>

#include "scene/scene.hpp"

namespace vibrosow {

/// Balls of 4 mm, six deep, over two round holes of 16 mm: a tray that the table of one hole knows.
inline Scene table_tray_scene() {
  Scene scene;
  scene.space = Space::three_dimensional;
  scene.lots = {{.name = "balls", .diameter = 4e-3, .mass = 40e-6}};
  Vessel& tray = scene.tray;
  tray.name = "tray";
  tray.length = 128e-3, tray.depth = 64e-3, tray.height = 80e-3;
  tray.holes = {{.centre = 32e-3, .width = 16e-3, .shape = HoleShape::round},
                {.centre = 96e-3, .width = 16e-3, .shape = HoleShape::round}};
  tray.fill = Fill{};
  tray.fill->count = static_cast<int>(std::lround(0.6 * 32 * 16 * 6 / (std::numbers::pi / 6)));
  tray.motion = HarmonicMotion{.amplitude = 8e-3, .frequency = 5};
  return scene;
}

}  // namespace vibrosow
