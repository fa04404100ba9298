#include "simulation/counter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "elementary/functions.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {

std::size_t Counter::next_flag(std::size_t from) const {
  if (from >= flags_.size()) return flags_.size();
  const void* found = std::memchr(flags_.data() + from, 1, flags_.size() - from);
  return found ? static_cast<std::size_t>(static_cast<const char*>(found) - flags_.data()) : flags_.size();
}

double Counter::within_period(double x) const {
  return tray_.sides == Sides::periodic ? x - tray_.length * std::floor(x / tray_.length) : x;
}

int Counter::hole_at(double x) const {
  for (std::size_t k = 0; k < tray_.holes.size(); ++k)
    if (std::abs(x - tray_.holes[k].centre) <= 0.5 * tray_.holes[k].width) return static_cast<int>(k) + 1;
  const bool on_floor = tray_.sides == Sides::periodic || (x > 0 && x < tray_.length);
  return tray_.box && on_floor ? through_the_floor : 0;
}

int Counter::hole_beside(double x, double reach) const {
  int nearest = through_the_floor;
  for (std::size_t k = 0; k < tray_.holes.size(); ++k) {
    const double past_edge = std::abs(x - tray_.holes[k].centre) - 0.5 * tray_.holes[k].width;
    if (past_edge <= reach) nearest = static_cast<int>(k) + 1, reach = past_edge;
  }
  return nearest;
}

void Counter::watch(const Grains& grains, const Walls& walls, const GrainLoops& loops, double time,
                    std::vector<OutflowEvent>& events) {
  const Pose pose = walls.poses().front();
  const double angle = tray_.tilt + pose.angle;
  const auto [sine, cosine] = elementary::sine_cosine(angle);
  const double ox = tray_.origin.x() + pose.displacement.x(), oy = tray_.origin.y() + pose.displacement.y();
  const PoseRate rate = walls.rate(0, time);
  const Eigen::Vector2d& tray_velocity = rate.velocity;
  const double spin = rate.angular_velocity;

  // Most grains are above the floor and were so before: they are passed over unseen.
  const std::size_t n = grains.size();
  flags_.resize(n);
  loops.flag_below(n, grains.x.data(), grains.y.data(), -sine, cosine, cosine * oy - sine * ox, state_.below.data(),
                   flags_.data());
  for (std::size_t i = next_flag(0); i < n; i = next_flag(i + 1)) {
    const double height = cosine * (grains.y[i] - oy) - sine * (grains.x[i] - ox);
    CounterState::Passage& passage = state_.passages[i];
    if (height >= 0) {
      state_.below[i] = 0;
      continue;
    }
    if (passage.counted) continue;
    const double along = cosine * (grains.x[i] - ox) + sine * (grains.y[i] - oy);
    const double ux = grains.vx[i] - (tray_velocity.x() - spin * (grains.y[i] - oy));
    const double uy = grains.vy[i] - (tray_velocity.y() + spin * (grains.x[i] - ox));
    const double speed_along = cosine * ux + sine * uy, speed_up = cosine * uy - sine * ux;
    // Back along the present velocity to the moment when the centre was `level` high.
    const auto since = [&](double level) { return speed_up < 0 ? (height - level) / speed_up : 0.0; };
    if (!state_.below[i]) {
      state_.below[i] = 1;
      passage.x = within_period(along - speed_along * since(0));
      passage.hole = hole_at(passage.x);
      // The edge may lie in the waist of a clump: its centre then passes beside the opening. A disc of it that goes
      // through the floor itself is seen by the walls.
      if (passage.hole == through_the_floor && grains.oriented)
        passage.hole = hole_beside(passage.x, grains.kind(i).radius);
    }
    if (height >= -count_below_) continue;
    passage.counted = true;
    if (passage.hole == through_the_floor) {
      ++state_.lost;
      continue;
    }
    const double ago = since(-count_below_);
    const double x = passage.hole > 0 ? passage.x : within_period(along - speed_along * ago);
    events.push_back({time - ago, passage.hole, grains.lot[i], grains.id[i], grains.kind(i).mass, x,
                      elementary::hypot(grains.vx[i], grains.vy[i])});
  }
}

void Counter::remove_flagged(const std::vector<char>& removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < state_.passages.size(); ++i)
    if (!removed[i]) state_.passages[kept] = state_.passages[i], state_.below[kept++] = state_.below[i];
  state_.passages.resize(kept), state_.below.resize(kept);
}

bool is_inside(const Vessel& vessel, const Pose& pose, double x, double y) {
  const Eigen::Vector2d own = in_vessel_frame(vessel, pose, {x, y});
  const bool along = vessel.sides == Sides::periodic || (own.x() >= 0 && own.x() <= vessel.length);
  return along && own.y() >= 0 && own.y() <= vessel.height;
}

}  // namespace vibrosow
