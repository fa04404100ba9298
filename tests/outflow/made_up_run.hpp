#pragma once

#include <vector>

#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A tray of `holes` holes, 10 cm apart and 16 mm wide, measured from 2 s to 10 s; one lot of 4 mm and 40 mg.
inline Scene made_up_scene(int holes) {
  Scene scene;
  scene.lots = {{.name = "wheat", .diameter = 4e-3, .mass = 40e-6}};
  scene.tray.name = "tray";
  scene.tray.length = 0.5;
  for (int i = 0; i < holes; ++i) scene.tray.holes.push_back({0.1 * (i + 1), 0.016});
  scene.run.duration = 10;
  scene.run.measure_from = 2;
  return scene;
}

/// A run to the scene's end in which nothing has left yet of a full tray.
inline Run made_up_run(const Scene& scene) {
  Run run;
  run.dt = 1e-3;
  run.end_time = scene.run.duration;
  run.balance.put_in = run.balance.inside = run.tray_at_begin = run.tray_at_end = 1000;
  run.steps = static_cast<std::int64_t>(scene.run.duration / run.dt);
  return run;
}

inline void add_grain(Run& run, double time, int hole, int lot = 0, double mass = 40e-6) {
  run.events.push_back({time, hole, lot, static_cast<std::int64_t>(run.events.size()), mass, 0.1, 0.6});
  ++(hole > 0 ? run.balance.counted : run.balance.spilled);
  ++run.balance.put_in;
}

}  // namespace vibrosow
