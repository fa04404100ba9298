#include "fields/tray_frame.hpp"

#include <algorithm>
#include <cmath>

#include "compute/nearest_image.hpp"
#include "grains/orientation.hpp"
#include "portable_math/functions.hpp"
#include "scene/motion.hpp"
#include "vessel/directions.hpp"

namespace vibrosow {
namespace {

Eigen::Matrix2d turned_back(double angle) {
  return angle == 0 ? Eigen::Matrix2d(Eigen::Matrix2d::Identity()) : rotation(-angle);
}

void put_at_rest(Snapshot& s) {
  s.tray_x = s.tray_y = s.tray_z = s.tray_angle = s.tray_vx = s.tray_vy = s.tray_vz = s.tray_spin = 0;
}

bool is_at_rest(const Snapshot& s) {
  return s.tray_x == 0 && s.tray_y == 0 && s.tray_z == 0 && s.tray_angle == 0 && s.tray_vx == 0 && s.tray_vy == 0 &&
         s.tray_vz == 0 && s.tray_spin == 0;
}

/// The tray turns about the axis across.
void take_off_what_is_across(Snapshot& own, double front, const Eigen::Matrix2d& now) {
  for (std::size_t i = 0; i < own.size(); ++i) {
    own.z[i] -= front + own.tray_z, own.vz[i] -= own.tray_vz;
    own.start_z[i] -= front;
    const Eigen::Vector2d spin = now * Eigen::Vector2d(own.omega_x[i], own.omega_y[i]);
    own.omega_x[i] = spin.x(), own.omega_y[i] = spin.y();
  }
}

/// By an angle (rad) about the axis across.
void turn_clumps_back(Snapshot& own, double angle) {
  if (angle == 0) return;
  const Orientation back{portable_math::cos(0.5 * angle), 0, 0, -portable_math::sin(0.5 * angle)};
  for (std::size_t i = 0; i < own.q_w.size(); ++i) {
    const Orientation q = back * Orientation{own.q_w[i], own.q_x[i], own.q_y[i], own.q_z[i]};
    own.q_w[i] = q.w, own.q_x[i] = q.x, own.q_y[i] = q.y, own.q_z[i] = q.z;
  }
}

void bring_within(std::vector<double>& places, double period) {
  if (period == 0) return;
  for (double& place : places) place = within_period(place, period);
}

/// Calls `act` with each array of a snapshot that has an entry a grain.
void for_each_array(const auto& act) {
  using S = Snapshot;
  const auto with = [&](auto... arrays) { (act(arrays), ...); };
  with(&S::x, &S::y, &S::vx, &S::vy, &S::omega, &S::angle, &S::lot, &S::id, &S::radius, &S::mass, &S::area, &S::start_x,
       &S::start_y, &S::z, &S::vz, &S::omega_x, &S::omega_y, &S::q_w, &S::q_x, &S::q_y, &S::q_z, &S::start_z,
       &S::volume, &S::in_tray);
}

void append(Snapshot& to, const Snapshot& from, std::size_t i) {
  for_each_array([&](auto array) {
    if (!(from.*array).empty()) (to.*array).push_back((from.*array)[i]);
  });
}

/// Appends grain `i` of `from`, moved (m).
void append_moved(Snapshot& to, const Snapshot& from, std::size_t i, double along, double across) {
  append(to, from, i);
  to.x.back() += along;
  if (to.is_3d()) to.z.back() += across;
}

}  // namespace

Periods periods_of(const Vessel& tray, bool is_3d) {
  return {tray.sides == Sides::periodic ? tray.length : 0,
          is_3d && tray.front_and_back == Sides::periodic ? *tray.depth : 0};
}

Snapshot in_tray_frame(const Snapshot& lab, const Vessel& tray) {
  if (turns_steadily(tray) && !is_at_rest(lab)) {
    Snapshot still = lab;
    put_at_rest(still);
    return in_tray_frame(still, tray);
  }
  const Eigen::Matrix2d now = turned_back(tray.tilt + lab.tray_angle), at_rest = turned_back(tray.tilt);
  const Eigen::Vector2d origin = tray.origin + Eigen::Vector2d(lab.tray_x, lab.tray_y);
  Snapshot own = lab;
  for (std::size_t i = 0; i < lab.size(); ++i) {
    const Eigen::Vector2d arm = Eigen::Vector2d(lab.x[i], lab.y[i]) - origin;
    const Eigen::Vector2d tray_velocity(lab.tray_vx - lab.tray_spin * arm.y(), lab.tray_vy + lab.tray_spin * arm.x());
    const Eigen::Vector2d place = now * arm;
    const Eigen::Vector2d velocity = now * (Eigen::Vector2d(lab.vx[i], lab.vy[i]) - tray_velocity);
    const Eigen::Vector2d start = at_rest * (Eigen::Vector2d(lab.start_x[i], lab.start_y[i]) - tray.origin);
    own.x[i] = place.x(), own.y[i] = place.y();
    own.vx[i] = velocity.x(), own.vy[i] = velocity.y();
    own.omega[i] -= lab.tray_spin;
    own.start_x[i] = start.x(), own.start_y[i] = start.y();
  }
  for (double& angle : own.angle) angle -= tray.tilt + lab.tray_angle;
  turn_clumps_back(own, tray.tilt + lab.tray_angle);
  if (lab.is_3d()) take_off_what_is_across(own, tray.front, now);
  put_at_rest(own);
  const Periods periods = periods_of(tray, own.is_3d());
  bring_within(own.x, periods.along), bring_within(own.z, periods.across);
  return own;
}

Snapshot with_images(const Snapshot& own, const Periods& periods, double reach) {
  Snapshot bed = own;
  const auto is_near = [](double at, double period, double beyond) {
    return period == 0 || (at >= -beyond && at <= period + beyond);
  };
  const double widest = own.size() == 0 ? 0 : *std::ranges::max_element(own.radius);
  const auto images = [&](double period) {
    return period > 0 ? static_cast<int>(std::ceil((reach + widest) / period)) : 0;
  };
  const int along = images(periods.along), across = images(periods.across);
  for (int i = -along; i <= along; ++i)
    for (int k = -across; k <= across; ++k) {
      if (i == 0 && k == 0) continue;
      const double dx = i * periods.along, dz = k * periods.across;
      for (std::size_t grain = 0; grain < own.size(); ++grain) {
        const double beyond = reach + own.radius[grain];
        if (!is_near(own.x[grain] + dx, periods.along, beyond)) continue;
        if (own.is_3d() && !is_near(own.z[grain] + dz, periods.across, beyond)) continue;
        append_moved(bed, own, grain, dx, dz);
      }
    }
  return bed;
}

Snapshot part_of(const Snapshot& bed, const std::vector<std::size_t>& grains) {
  Snapshot part = bed;
  for_each_array([&](auto array) { (part.*array).clear(); });
  for (const std::size_t i : grains) append(part, bed, i);
  return part;
}

std::vector<std::size_t> grains_in_tray(const Snapshot& own, const Vessel& tray) {
  std::vector<std::size_t> inside;
  if (own.in_tray.size() == own.size()) {
    for (std::size_t i = 0; i < own.size(); ++i)
      if (own.in_tray[i] != 0) inside.push_back(i);
    return inside;
  }
  const auto within = [](double at, double end) { return at >= 0 && at <= end; };
  for (std::size_t i = 0; i < own.size(); ++i)
    if (within(own.x[i], tray.length) && within(own.y[i], tray.height) &&
        (!own.is_3d() || within(own.z[i], *tray.depth)))
      inside.push_back(i);
  return inside;
}

}  // namespace vibrosow
