#include "outflow/flow.hpp"

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

std::vector<OutflowEvent> events_of(const Run& run, int hole) {
  std::vector<OutflowEvent> events;
  std::ranges::copy_if(run.events, std::back_inserter(events),
                       [&](const OutflowEvent& e) { return e.hole > 0 && (hole == 0 || e.hole == hole); });
  return events;
}

double end_of_flow(const Run& run) {
  if (run.tray_empty_since < 0) return run.end_time;
  const double last = run.events.empty() ? 0 : run.events.back().time;
  return std::min(run.end_time, std::max(run.tray_empty_since, last));
}

/// `last`: whether an event or pause at the window's very end is its own.
FlowWindow measure(const Scene& scene, const std::vector<OutflowEvent>& events, const std::vector<Pause>& all_pauses,
                   FlowWindow window, bool last) {
  const auto holds = [&](double time) {
    return time >= window.from && (time < window.to || (last && time == window.to));
  };
  double left = 0, right = 0;
  for (const OutflowEvent& event : events) {
    if (!holds(event.time)) continue;
    ++window.grains;
    window.mass += event.mass;
    (event.x < scene.tray.holes[static_cast<std::size_t>(event.hole - 1)].centre ? left : right) += event.mass;
  }
  if (window.grains > 0) window.asymmetry = (left - right) / (left + right);
  for (const Pause& pause : all_pauses) {
    window.paused += std::max(0.0, std::min(pause.to, window.to) - std::max(pause.from, window.from));
    if (!holds(pause.from)) continue;
    ++window.pauses;
    window.longest_pause = std::max(window.longest_pause, pause.length());
  }
  return window;
}

}  // namespace

std::vector<Pause> pauses(const std::vector<double>& times, double from, double to, double threshold) {
  std::vector<Pause> found;
  double last = from;
  const auto look = [&](double time) {
    if (time - last > threshold) found.push_back({last, time});
    last = time;
  };
  for (const double time : times)
    if (time >= from && time <= to) look(time);
  look(to);
  return found;
}

double pause_threshold(const Scene& scene) {
  double diameter = 0;
  for (const SeedLot& lot : scene.lots) diameter += lot.number_fraction * lot.diameter;
  return 5 * std::sqrt(diameter / standard_gravity);
}

std::vector<FlowWindow> flow_over_time(const Scene& scene, const Run& run) {
  const int holes = static_cast<int>(scene.tray.holes.size());
  const double end = end_of_flow(run), threshold = pause_threshold(scene);
  std::vector<FlowWindow> rows;
  const auto add = [&](int hole) {
    const std::vector<OutflowEvent> events = events_of(run, hole);
    std::vector<double> times;
    for (const OutflowEvent& event : events) times.push_back(event.time);
    const std::vector<Pause> found = pauses(times, 0, end, threshold);
    const auto edge = [&](int k) { return end * k / flow_windows; };
    for (int k = 0; k < flow_windows; ++k)
      rows.push_back(
          measure(scene, events, found, {.from = edge(k), .to = edge(k + 1), .hole = hole}, k + 1 == flow_windows));
    rows.push_back(measure(scene, events, found, {.from = 0, .to = end, .hole = hole}, true));
  };
  for (int hole = 1; hole <= holes; ++hole) add(hole);
  if (holes > 1) add(0);
  return rows;
}

}  // namespace vibrosow
