#pragma once

#include <optional>
#include <vector>

#include "loops/grain_loops.hpp"
#include "simulation/state.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Watches grains leave. A grain belongs to the hole whose opening its centre passes in the tray's frame; it is counted
/// when its centre crosses the counting line, `count_below` under the tray's floor and as wide as the world. One that
/// passes no hole is spilled. Of a clump the centre may pass beside the opening, as far as its circle reaches. From a
/// tray that turns over and over, or while a table has tipped it over, a grain is spilled where it is `count_below`
/// below all that the tray reaches.
class Counter {
 public:
  Counter(const Scene& scene, CounterState& state)
      : tray_(scene.tray),
        is_3d_(scene.space == Space::three_dimensional),
        count_below_(scene.run.count_below),
        line_below_(line_below(scene.tray)),
        state_(state) {}

  /// Looks at every grain after a step that ended at `time`; new events are appended.
  void watch(const Grains& grains, const Walls& walls, const GrainLoops& loops, double time,
             std::vector<OutflowEvent>& events);

  void add_grain() { state_.passages.push_back({}), state_.below.push_back(0); }
  void remove_flagged(const std::vector<char>& removed);
  bool is_counted(std::size_t i) const { return state_.passages[i].counted; }  // or spilled, or lost
  /// Grains that the last look found to have come through the floor beside its holes.
  const std::vector<int>& lost_now() const { return lost_now_; }

 private:
  static constexpr int through_the_floor = -1;
  /// A place on the floor, in the tray's frame, m; in the plane z is 0.
  struct FloorPoint {
    double x, z;
  };
  int hole_at(const FloorPoint& place, bool by_line) const;
  /// m, from a hole's edge; negative over the hole.
  double past_edge(const Hole& hole, const FloorPoint& place) const;
  std::size_t next_flag(std::size_t from) const;
  FloorPoint within_period(const FloorPoint& place) const;
  /// The hole whose edge is no farther from a place than `reach` (m), of several the nearest; else 0 within it of an
  /// open end, over which it is spilled; else through_the_floor.
  int hole_beside(const FloorPoint& place, double reach) const;

  const Vessel& tray_;
  bool is_3d_;
  double count_below_;
  std::optional<Pose> line_below_;  // of a tray that turns over and over, or is tipped over
  CounterState& state_;
  std::vector<char> flags_;  // of those to look at
  std::vector<int> lost_now_;
};

/// Whether a grain's centre lies inside a vessel, between its ends (a periodic one has none), above its floor line and
/// below the tops of its end walls.
bool is_inside(const Vessel& vessel, const Pose& pose, const Grains& grains, std::size_t i);

}  // namespace vibrosow
