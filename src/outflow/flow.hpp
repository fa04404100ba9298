#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A time without a grain, s.
struct Pause {
  double from, to;
  double length() const { return to - from; }
};

/// Pauses longer than `threshold` (s) between `from` and `to` (s), whose ends count as events. `times`: ascending, s.
std::vector<Pause> pauses(const std::vector<double>& times, double from, double to, double threshold);

/// From where on a gap in the outflow is a pause: 5 sqrt(d / g), in which a grain falls 12.5 diameters from rest. d:
/// mean diameter, by number, over all lots.
double pause_threshold(const Scene& scene);

/// Outflow of one hole, or of all, over a part of the run.
struct FlowWindow {
  double from = 0, to = 0;  // s
  int hole = 0;             // 1.. from the left; 0: all
  std::int64_t grains = 0;
  double mass = 0;                    // kg
  std::optional<double> asymmetry{};  // (L - R) / (L + R) of the mass passing left and right of its hole's centre
  std::int64_t pauses = 0;            // that begin in the window
  double longest_pause = 0;           // s, of these, in full; 0 without one
  double paused = 0;                  // s, in pauses, of the window
  double paused_fraction() const { return to > from ? paused / (to - from) : 0; }
};

/// Into how many equal parts a run is cut for its flow over time.
inline constexpr int flow_windows = 10;

/// Hole by hole, then all holes where there are several: the run in `flow_windows` equal windows, then the whole run.
/// Pauses are those of the whole run, so that counts and times of the windows sum to the whole's. The run begins at 0
/// and ends where it ended, or with the last grain when its tray ran dry. Spilled grains do not count.
std::vector<FlowWindow> flow_over_time(const Scene& scene, const Run& run);

}  // namespace vibrosow
