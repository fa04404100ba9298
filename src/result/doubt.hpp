#pragma once

#include <string>

namespace vibrosow {

/// What may speak against a figure, by where it is known.
enum class DoubtKind {
  // Of a run:
  outside_the_model,
  ran_dry,
  drained,
  stopped_flowing,
  seeds_lost,
  feeder_behind,
  guard_warned,
  stopped_by_guard,
  interrupted,
  before_the_window,  // it ended before measuring began
  few_seeds,
  part_of_a_period,  // the window is shorter than one of the drive
  // Of the replicates of a layout together:
  clogged_replicates,
  wide_interval,
  skewed_replicates,
  // Of a scene:
  unlikely_scene,     // it can be run, but can hardly be meant
  outside_the_table,  // of one hole, whose slopes give the tolerance of what is expected
  beyond_the_levels,  // softer, or of longer steps, than any level whose error was measured
  // Of what was fitted to runs:
  runs_left_out,     // they count for nothing
  two_kinds_of_run,  // of one setting: some clogged
  errors_interact,
  no_limit,        // errors are against a setting that errs too
  depth_left_out,  // the plane's own error
  nothing_fitted,
  misfit,
  confused_values,  // not told apart
  little_learned,
  edge_of_range,
  wider_than_its_range,
  few_points,
  nothing_held_out,
  // Of a run; kept runs know kinds by their numbers, so these come last.
  seeds_spilled,
  flow_changed,  // in the window, by more than chance
  sizes_drawn,   // for a fill, far from those that were asked for
};
inline constexpr DoubtKind last_doubt_kind = DoubtKind::sizes_drawn;

struct Doubt {
  DoubtKind kind;
  std::string text;  // of this one: "ran dry at 3.2 s"
  bool operator==(const Doubt&) const = default;
};

}  // namespace vibrosow
