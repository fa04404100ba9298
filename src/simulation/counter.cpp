#include "simulation/counter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "compute/nearest_image.hpp"
#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "vessel/directions.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {

std::size_t Counter::next_flag(std::size_t from) const {
  if (from >= flags_.size()) return flags_.size();
  const void* found = std::memchr(flags_.data() + from, 1, flags_.size() - from);
  return found ? static_cast<std::size_t>(static_cast<const char*>(found) - flags_.data()) : flags_.size();
}

namespace {

/// Of a place on the floor or above it, in the vessel's frame.
bool is_between_ends(const Vessel& vessel, bool is_3d, double x, double z) {
  const auto between = [](Sides sides, double at, double length) {
    return sides == Sides::periodic || (at >= 0 && at <= length);
  };
  if (is_3d && vessel.plan == Plan::round) {
    const double radius = 0.5 * vessel.length;
    return portable_math::hypot(x - radius, z - radius) <= radius;
  }
  return between(vessel.sides, x, vessel.length) && (!is_3d || between(vessel.front_and_back, z, *vessel.depth));
}

}  // namespace

Counter::FloorPoint Counter::within_period(const FloorPoint& place) const {
  return {tray_.sides == Sides::periodic ? vibrosow::within_period(place.x, tray_.length) : place.x,
          is_3d_ && tray_.front_and_back == Sides::periodic ? vibrosow::within_period(place.z, *tray_.depth) : place.z};
}

double Counter::past_edge(const Hole& hole, const FloorPoint& place) const {
  const auto apart = [](Sides sides, double distance, double period) {
    return std::abs(sides == Sides::periodic ? nearest_image(distance, period) : distance);
  };
  const double along = apart(tray_.sides, place.x - hole.centre, tray_.length);
  const double across = is_3d_ ? apart(tray_.front_and_back, place.z - hole.across, *tray_.depth) : 0;
  if (!is_3d_) return along - 0.5 * hole.width;
  if (hole.shape == HoleShape::round) return portable_math::hypot(along, across) - 0.5 * hole.rim_width();
  return std::max(along - 0.5 * hole.width, across - 0.5 * hole.across_length);
}

int Counter::hole_at(const FloorPoint& place, bool by_line) const {
  if (by_line) return 0;
  for (std::size_t k = 0; k < tray_.holes.size(); ++k)
    if (past_edge(tray_.holes[k], place) <= 0) return static_cast<int>(k) + 1;
  if (line_below_) return 0;  // it fell out before the tray came back
  return tray_.box && is_between_ends(tray_, is_3d_, place.x, place.z) ? through_the_floor : 0;
}

int Counter::hole_beside(const FloorPoint& place, double reach) const {
  int nearest = through_the_floor;
  for (std::size_t k = 0; k < tray_.holes.size(); ++k) {
    const double apart = past_edge(tray_.holes[k], place);
    if (apart <= reach) nearest = static_cast<int>(k) + 1, reach = apart;
  }
  const auto is_near_an_end = [reach](Sides sides, double at, double length) {
    return sides == Sides::open && std::min(at, length - at) <= reach;
  };
  if (nearest == through_the_floor && (is_near_an_end(tray_.sides, place.x, tray_.length) ||
                                       (is_3d_ && is_near_an_end(tray_.front_and_back, place.z, *tray_.depth))))
    return 0;
  return nearest;
}

void Counter::watch(const Grains& grains, const Walls& walls, const GrainLoops& loops, double time,
                    std::vector<OutflowEvent>& events) {
  lost_now_.clear();
  const bool by_line = line_below_ && (turns_over(tray_) || !stands(tray_, walls.poses().front()));
  const Pose pose = by_line ? *line_below_ : walls.poses().front();
  const double angle = tray_.tilt + pose.angle;
  const auto [sine, cosine] = portable_math::sine_cosine(angle);
  const double ox = tray_.origin.x() + pose.displacement.x(), oy = tray_.origin.y() + pose.displacement.y();
  const double oz = tray_.front + pose.across;
  const PoseRate rate = by_line ? PoseRate{} : walls.rate(0, time);
  const Eigen::Vector2d& tray_velocity = rate.velocity;
  const double spin = rate.angular_velocity;
  const Eigen::Vector2d turned = unit_vector(pose.turn);

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
      if (!by_line) passage.hole = 0;  // it has come back
      continue;
    }
    if (passage.counted) continue;
    const double along = cosine * (grains.x[i] - ox) + sine * (grains.y[i] - oy);
    const double ux = grains.vx[i] - (tray_velocity.x() - spin * (grains.y[i] - oy));
    const double uy = grains.vy[i] - (tray_velocity.y() + spin * (grains.x[i] - ox));
    const double across = is_3d_ ? grains.z[i] - oz : 0,
                 speed_across = is_3d_ ? grains.vz[i] - rate.across_velocity : 0;
    const double speed_along = cosine * ux + sine * uy, speed_up = cosine * uy - sine * ux;
    // Above which place of the floor, which may turn in itself, it was `ago` (s) before.
    const auto place_before = [&](double ago) {
      const double x = along - (speed_along + rate.turn_rate * across) * ago;
      const double z = across - (speed_across - rate.turn_rate * along) * ago;
      if (pose.turn == 0) return within_period({x, z});
      return FloorPoint{turned.x() * x + turned.y() * z, turned.x() * z - turned.y() * x};
    };
    // Back along the present velocity to the moment when the centre was `level` high.
    const auto since = [&](double level) { return speed_up < 0 ? (height - level) / speed_up : 0.0; };
    const bool has_passed = by_line && passage.hole > 0;  // before the tray tipped over
    const bool is_new = !state_.below[i] && !has_passed;
    state_.below[i] = 1;
    if (is_new) {
      const FloorPoint place = place_before(since(0));
      passage.x = place.x, passage.z = place.z;
      passage.hole = hole_at(place, by_line);
      // The edge may lie in the waist of a clump: its centre then passes beside the opening. A disc of it that goes
      // through the floor itself is seen by the walls.
      if (passage.hole == through_the_floor && grains.oriented)
        passage.hole = hole_beside(place, grains.kind(i).radius);
    }
    if (!(height < -count_below_)) continue;  // nor what is not a number: that is the guard's
    passage.counted = true;
    if (passage.hole == through_the_floor) {
      lost_now_.push_back(static_cast<int>(i));
      continue;
    }
    const double ago = since(-count_below_);
    const FloorPoint place = passage.hole > 0 ? FloorPoint{passage.x, passage.z} : place_before(ago);
    const double in_plane = portable_math::hypot(grains.vx[i], grains.vy[i]);
    events.push_back({time - ago, passage.hole, grains.lot[i], grains.id[i], grains.kind(i).mass, place.x,
                      is_3d_ ? portable_math::hypot(in_plane, grains.vz[i]) : in_plane, place.z});
  }
}

void Counter::remove_flagged(const std::vector<char>& removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < state_.passages.size(); ++i)
    if (!removed[i]) state_.passages[kept] = state_.passages[i], state_.below[kept++] = state_.below[i];
  state_.passages.resize(kept), state_.below.resize(kept);
}

bool is_inside(const Vessel& vessel, const Pose& pose, const Grains& grains, std::size_t i) {
  const Eigen::Vector3d own = point_in_vessel(vessel, pose, grains.place(i));
  return own.y() >= 0 && own.y() <= vessel.height && is_between_ends(vessel, grains.is_3d, own.x(), own.z());
}

}  // namespace vibrosow
