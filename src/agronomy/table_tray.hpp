#pragma once

#include <optional>
#include <string>

#include "agronomy/hole_table.hpp"
#include "agronomy/sowing_plan.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A tray of equal round holes that is shaken along, as the table of one hole knows it.
struct TableTray {
  PlannedSeed seed;
  HoleConditions at;  // of each of its holes
  int holes = 1;
  double amplitude = 0;  // m
  double frequency = 0;  // Hz
};

/// A mixture is seeds of its mean (planned_seed). Throws InputError "KEY: .." for a tray that the table does not tell
/// of: of the plane, with slots or unequal holes, with a gate, tilted, turned or shaken otherwise than along, or fed by
/// anything but a fill.
TableTray table_tray(const Scene& scene);

/// The tray of a planned layout, which feeds `layout.feed.rows` rows.
TableTray table_tray(const SowingTask& task, const PlannedLayout& layout);

/// "KEY: 12 SEEDS is outside the table of one hole, which has 2 to 6.5", of a value in `unit`; empty within.
std::string outside_table(const char* key, double value, const Span& known, const char* unit);
/// Of all of a tray's conditions: the first that is outside, its seeds' shape before all.
std::string outside_table(const HoleConditions& at, const HoleTable& table);

/// What a simulated tray's rate may be off by because it is not built as it was drawn.
struct TrayTolerance {
  std::optional<double> deviation;  // of the rate's logarithm; none: the table has no slopes for such a tray
  std::string outside;  // why there is none, or why it is that of the table's nearest place; empty: of the tray's own
};

/// Of a scene in 3D, by the table's own slopes at its holes' width over the seed's size and its peak speed; all
/// holes err alike, as of one drill bit. Round holes may be unequal: each counts by its outflow. Several lots
/// are seeds of their mean. The depth of the bed, how it is fed and how the floor slopes are left aside. None without
/// round holes, or where the tray is not shaken to and fro.
TrayTolerance tray_tolerance(const Scene& scene, const HoleTable& table, const BuildTolerance& tolerance = {});

}  // namespace vibrosow
