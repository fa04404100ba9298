#pragma once

#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// The time over which outflow is measured. A shaken tray sows in the rhythm of its drive, so a window of whole periods
/// alone says what it sows in the long run.
struct MeasuringWindow {
  enum class Drive { still, periodic, aperiodic };

  double from = 0, to = 0;  // s; nothing is measured where to <= from
  Drive drive = Drive::still;
  double period = 0;  // s, of the slowest part of a periodic drive
  int periods = 0;    // whole ones that it holds; 0: it is shorter than one, or the drive is not periodic

  double length() const { return to - from; }
  bool empty() const { return to <= from; }
  /// The same of a run that ended at `end` (s).
  MeasuringWindow until(double end) const;
};

/// What a scene measures over: from `run.measure_from`, or as much later as makes it whole periods of the slowest part
/// of the drive of its vessels, to the end of the run. A window shorter than a period, of a tray without holes, of a
/// drive that has stopped before or that is a table, is left as it was written.
MeasuringWindow measuring_window(const Scene& scene);

/// The window in five or six equally long blocks that follow each other, s: of whole periods where it has so many, and
/// what of it is then left over before the first. Their ends, the first's beginning included; empty for an empty one.
std::vector<double> block_ends(const MeasuringWindow& window);

/// The same in equal parts of about a tenth of the window, of whole periods of a periodic drive, whose rhythm is no
/// instability: ten of a window of 10, 20, 30 .. periods, else as many as there are of the periods nearest to a tenth,
/// at least one. None of a window shorter than two periods.
std::vector<double> instability_ends(const MeasuringWindow& window);

}  // namespace vibrosow
