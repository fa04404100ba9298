#pragma once

#include <vector>

#include "compute/grain_loops.hpp"
#include "grains/grains.hpp"
#include "result/run.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Watches grains leave. A grain belongs to the hole whose opening its centre passes in the tray's frame; it is counted
/// when its centre crosses the counting line, `count_below` under the tray's floor and as wide as the world. One that
/// passes no hole is spilled. Of a clump the centre may pass beside the opening, as far as its circle reaches.
class Counter {
 public:
  Counter(const Scene& scene, std::size_t grains);

  /// Looks at every grain after a step that ended at `time`; new events are appended.
  void watch(const Grains& grains, const Walls& walls, const GrainLoops& loops, double time,
             std::vector<OutflowEvent>& events);

  void add_grain() { state_.push_back({}), below_.push_back(0); }
  void remove_flagged(const std::vector<char>& removed);
  bool is_counted(std::size_t i) const { return state_[i].counted; }  // or spilled, or lost
  std::int64_t lost() const { return lost_; }                         // came through the floor beside its holes

 private:
  struct State {
    bool counted = false;
    int hole = 0;  // passed; 0: none, it fell beside the tray
    double x = 0;  // m, where
  };
  static constexpr int through_the_floor = -1;
  int hole_at(double x) const;
  std::size_t next_flag(std::size_t from) const;
  double within_period(double x) const;
  /// The hole whose nearer edge is no farther from x than `reach` (m), of several the nearest; else through_the_floor.
  int hole_beside(double x, double reach) const;

  Vessel tray_;
  double count_below_;
  std::vector<State> state_;
  std::vector<char> below_;  // whether a grain is under the floor
  std::vector<char> flags_;  // of those to look at
  std::int64_t lost_ = 0;
};

/// Whether a point of the lab lies inside a vessel, between its ends (a periodic one has none),
/// above its floor line and below the tops of its end walls.
bool is_inside(const Vessel& vessel, const Pose& pose, double x, double y);

}  // namespace vibrosow
