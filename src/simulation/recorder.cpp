#include "simulation/recorder.hpp"

#include <algorithm>
#include <numbers>

#include "scene/clump_body.hpp"
#include "scene/clump_shape.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

double circle_area(double radius) {
  return std::numbers::pi * radius * radius;
}

double ball_volume(double radius) {
  return 4 * std::numbers::pi / 3 * (radius * radius * radius);
}

/// A lot's grain is so much of its circle, in 3D of its ball.
double filled_by(const SeedLot& lot) {
  if (lot.discs.empty()) return 1;
  const double radius = 0.5 * lot.diameter;
  if (is_solid_clump(lot)) return body_of_balls(lot.discs).volume / ball_volume(radius);
  return plate_of(lot.discs).area / circle_area(radius);
}

/// An array of an absent effect is empty.
std::vector<double> or_zeros(std::vector<double> values, std::size_t size) {
  values.resize(size, 0.0);
  return values;
}

}  // namespace

Snapshot snapshot_of(const Grains& grains, const Walls& walls, double time, std::size_t vessel) {
  const Pose pose = walls.pose(vessel, time);
  const PoseRate rate = walls.rate(vessel, time);
  Snapshot s;
  s.time = time;
  s.tray_x = pose.displacement.x(), s.tray_y = pose.displacement.y(), s.tray_angle = pose.angle;
  s.tray_vx = rate.velocity.x(), s.tray_vy = rate.velocity.y(), s.tray_spin = rate.angular_velocity;
  s.x = grains.x, s.y = grains.y;
  s.vx = grains.vx, s.vy = grains.vy;
  s.omega = or_zeros(grains.omega, grains.size());
  s.angle = grains.angle;
  s.lot = grains.lot;
  s.id = grains.id;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const GrainKind kind = grains.kind(i);
    s.radius.push_back(kind.radius);
    s.mass.push_back(kind.mass);
  }
  if (grains.is_3d) {
    s.tray_z = pose.across, s.tray_vz = rate.across_velocity;
    s.z = grains.z, s.vz = grains.vz;
    s.q_w = grains.q_w, s.q_x = grains.q_x, s.q_y = grains.q_y, s.q_z = grains.q_z;
    s.omega_x = or_zeros(grains.omega_x, grains.size()), s.omega_y = or_zeros(grains.omega_y, grains.size());
  }
  return s;
}

GrainExtents::GrainExtents(const std::vector<SeedLot>& lots) {
  for (const SeedLot& lot : lots) filled_.push_back(filled_by(lot));
}

void GrainExtents::add_to(Snapshot& s) const {
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double filled = filled_[static_cast<std::size_t>(s.lot[i])];
    if (s.is_3d())
      s.volume.push_back(filled * ball_volume(s.radius[i]));
    else
      s.area.push_back(filled * circle_area(s.radius[i]));
  }
}

Recorder::Recorder(const Scene& scene, RecorderState& state)
    : times_(scene.record->times), extents_(scene.lots), state_(state) {}

void Recorder::note_new(const Grains& grains) {
  const std::size_t known = state_.start.size();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto id = static_cast<std::size_t>(grains.id[i]);
    if (id < known) continue;
    state_.start.resize(std::max(state_.start.size(), id + 1));
    state_.start[id] = grains.place(i);
  }
}

bool Recorder::is_due(double time) const {
  // The last step may end a rounding error short of the run's duration, as in plan_step.
  const auto next = static_cast<std::size_t>(state_.taken);
  return next < times_.size() && time >= times_[next] * (1 - 1e-12);
}

void Recorder::record(const Grains& grains, const Walls& walls, double time, std::vector<Snapshot>& snapshots) {
  for (; is_due(time); ++state_.taken) snapshots.push_back(snapshot(grains, walls, time));
}

Snapshot Recorder::snapshot(const Grains& grains, const Walls& walls, double time) const {
  Snapshot s = snapshot_of(grains, walls, time);
  extents_.add_to(s);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Eigen::Vector3d& start = state_.start.at(static_cast<std::size_t>(grains.id[i]));
    s.start_x.push_back(start.x());
    s.start_y.push_back(start.y());
    if (grains.is_3d) s.start_z.push_back(start.z());
  }
  return s;
}

}  // namespace vibrosow
