#include "simulation/feeder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grains/places.hpp"
#include "grains/size_distribution.hpp"
#include "scene/seed_lot.hpp"
#include "simulation/counter.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

/// Grains of one vessel, in its own frame; in the plane z is 0.
struct Inside {
  bool in_space = false;
  int grains = 0;
  std::vector<Eigen::Vector3d> at;
  std::vector<double> radius;
  std::vector<char> lies;  // in the heap; otherwise it is falling

  /// In a periodic vessel with its images to either side.
  void add(const Vessel& vessel, const Eigen::Vector3d& own, double own_radius, bool in_heap) {
    const int along = vessel.sides == Sides::periodic ? 1 : 0;
    const int across = in_space && vessel.front_and_back == Sides::periodic ? 1 : 0;
    for (int i = -along; i <= along; ++i)
      for (int k = -across; k <= across; ++k) {
        const double depth = across == 0 ? 0 : *vessel.depth;
        at.emplace_back(own.x() + i * vessel.length, own.y(), own.z() + k * depth);
        radius.push_back(own_radius);
        lies.push_back(in_heap ? 1 : 0);
      }
  }
};

Eigen::Vector3d place_of(const Grains& grains, std::size_t i) {
  return {grains.x[i], grains.y[i], grains.in_space ? grains.z[i] : 0.0};
}

/// Those whose centre is in the vessel count; others that reach into it, at an outlet or over its edge, are in the way.
Inside grains_inside(const Vessel& vessel, const Pose& pose, const Grains& grains, const std::vector<char>& touching,
                     double largest_diameter) {
  Inside inside;
  inside.in_space = grains.in_space;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Eigen::Vector3d own = point_in_vessel(vessel, pose, place_of(grains, i));
    const double reach = grains.kind(i).radius + largest_diameter;
    if (own.x() < -reach || own.x() > vessel.length + reach || own.y() < -reach || own.y() > vessel.height + reach)
      continue;
    if (grains.in_space && (own.z() < -reach || own.z() > *vessel.depth + reach)) continue;
    if (is_inside(vessel, pose, grains, i)) ++inside.grains;
    inside.add(vessel, own, grains.kind(i).radius, touching[i] != 0);
  }
  return inside;
}

/// Lowest height above the heap at which a grain of `radius` at (x, z) is clear of all others: between those that are
/// still falling if there is room, so that a heap which sinks fast can be fed fast.
double free_height(const Inside& inside, const FloorPlace& place, double radius) {
  constexpr double clearance = 1.01;
  double height = radius;
  std::vector<std::pair<double, double>> falling;  // m, heights taken by grains in the air
  for (std::size_t k = 0; k < inside.at.size(); ++k) {
    const double reach = clearance * (radius + inside.radius[k]), dx = place.x() - inside.at[k].x();
    if (std::abs(dx) >= reach) continue;
    const double dz = place.y() - inside.at[k].z(), left2 = reach * reach - dx * dx - dz * dz;
    if (left2 <= 0) continue;
    const double y = inside.at[k].y(), half = std::sqrt(left2);
    if (inside.lies[k])
      height = std::max(height, y + half);
    else
      falling.emplace_back(y - half, y + half);
  }
  std::sort(falling.begin(), falling.end());
  for (const auto& [low, high] : falling)
    if (low < height) height = std::max(height, high);
  return height;
}

bool is_kept(const Vessel& vessel) {
  return vessel.fill && vessel.fill->keep;
}

/// Seeds that have come up to `time`.
std::int64_t arrivals(const Rain& rain, double time) {
  const double lasted = std::min(time, rain.stop) - rain.start;
  return lasted > 0 ? static_cast<std::int64_t>(std::floor(lasted * rain.rate * (1 + 1e-12))) : 0;
}

/// Whether a grain at `at` would touch nothing, a periodic tray's images included.
bool is_clear(const Grains& grains, const Walls& walls, const Eigen::Vector3d& at, double radius) {
  constexpr double clearance = 1.01;
  const Vessel& tray = walls.vessels().front();
  const double along = tray.sides == Sides::periodic ? tray.length : 0;
  const double across = grains.in_space && tray.front_and_back == Sides::periodic ? *tray.depth : 0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    Eigen::Vector3d apart = place_of(grains, i) - at;
    if (along > 0) apart.x() = std::remainder(apart.x(), along);
    if (across > 0) apart.z() = std::remainder(apart.z(), across);
    const double reach = clearance * (radius + grains.kind(i).radius);
    if (apart.squaredNorm() < reach * reach) return false;
  }
  for (std::size_t wall = 0; wall < walls.count(); ++wall)
    if (!walls.is_removed(wall) && std::sqrt(walls.distance2(wall, at)) < radius * (1 - 1e-9)) return false;
  return true;
}

}  // namespace

Feeder::Feeder(const Model& model, FeederState& state) : model_(model), state_(state) {
  for (const Vessel& vessel : model.vessels) {
    feeds_ = feeds_ || is_kept(vessel);
    rains_ = rains_ || vessel.rain;
  }
}

int Feeder::draw_lot(Random& random) const {
  if (model_.scene.lots.size() == 1) return 0;
  double rest = random.uniform();
  for (std::size_t lot = 0; lot + 1 < model_.scene.lots.size(); ++lot) {
    rest -= model_.scene.lots[lot].number_fraction;
    if (rest < 0) return static_cast<int>(lot);
  }
  return static_cast<int>(model_.scene.lots.size()) - 1;
}

void Feeder::note_waiting(const Vessel& vessel, int waiting, double time) {
  constexpr double noted_fraction = 0.25;
  if (!state_.warning.empty() || waiting <= noted_fraction * vessel.fill->count) return;
  state_.warning = fmt::format(
      "{}.fill.keep falls behind: {} of {} seeds missing at {:.4g} s, for want of room below the walls' top",
      vessel.name, waiting, vessel.fill->count, time);
}

int Feeder::top_up(Grains& grains, const std::vector<char>& touching, const Walls& walls, double time) {
  int added = 0;
  for (std::size_t v = 0; v < walls.vessels().size(); ++v) {
    const Vessel& vessel = walls.vessels()[v];
    if (!is_kept(vessel)) continue;
    const Pose pose = walls.poses()[v];
    const PoseRate rate = walls.rate(v, time);
    Inside inside = grains_inside(vessel, pose, grains, touching, model_.largest_diameter);
    const int missing = vessel.fill->count - inside.grains;
    int waiting = 0;
    for (int k = 0; k < missing; ++k) {
      const int lot = draw_lot(state_.random);
      const SeedLot& seeds = model_.scene.lots[static_cast<std::size_t>(lot)];
      const double size = draw_size(seeds, state_.random);
      const Turn turned = draw_turn(seeds, state_.random);
      const double radius = 0.5 * size * seeds.diameter;
      const FloorPlace place = grains.in_space ? random_place(vessel, radius, state_.random)
                                               : FloorPlace(state_.random.uniform(radius, vessel.length - radius), 0);
      const double y = free_height(inside, place, radius);
      if (y + radius > vessel.height) {
        ++waiting;
        continue;
      }
      const Eigen::Vector3d own(place.x(), y, place.y());
      inside.add(vessel, own, radius, false);
      const Eigen::Vector3d at = point_in_lab(vessel, pose, own);
      const GrainKind kind = sized_kind(seeds, *model_.law, model_.kinds[static_cast<std::size_t>(lot)], size);
      grains.add(at, point_velocity(vessel, pose, rate, at), lot, kind, turned);
      ++added;
    }
    note_waiting(vessel, waiting, time);
  }
  return added;
}

int Feeder::rain(Grains& grains, const Walls& walls, double time) {
  int added = 0;
  for (std::size_t v = 0; v < walls.vessels().size(); ++v)
    if (walls.vessels()[v].rain)
      added += rain(walls.vessels()[v], state_.showers[v], grains, walls,
                    steady_frame(walls.vessels()[v], walls.poses()[v]), time);
  return added;
}

void Feeder::draw_next(Shower& shower) const {
  shower.next_lot = draw_lot(shower.random);
  const SeedLot& seeds = model_.scene.lots[static_cast<std::size_t>(shower.next_lot)];
  shower.next_size = draw_size(seeds, shower.random);
  shower.next_turn = draw_turn(seeds, shower.random);
}

int Feeder::rain(const Vessel& vessel, Shower& shower, Grains& grains, const Walls& walls, const Pose& pose,
                 double time) {
  const Rain& rain = *vessel.rain;
  const std::int64_t waiting = arrivals(rain, time) - shower.arrived;
  int added = 0;
  for (std::int64_t k = 0; k < waiting; ++k) {
    if (shower.next_lot < 0) draw_next(shower);
    const std::size_t lot = static_cast<std::size_t>(shower.next_lot);
    const double radius = 0.5 * shower.next_size * model_.scene.lots[lot].diameter;
    const double margin = vessel.sides == Sides::walls ? std::min(radius, 0.5 * vessel.length) : 0;
    const double from = std::clamp(rain.from, margin, vessel.length - margin);
    const double to = std::clamp(rain.to, margin, vessel.length - margin);
    const double x = shower.random.uniform(from, to);
    const double z = grains.in_space ? random_across(vessel, radius, x, shower.random) : 0;
    const Eigen::Vector3d at = point_in_lab(vessel, pose, {x, rain.height, z});
    if (!is_clear(grains, walls, at, radius)) continue;
    const GrainKind kind = sized_kind(model_.scene.lots[lot], *model_.law, model_.kinds[lot], shower.next_size);
    grains.add(at, Eigen::Vector3d::Zero(), shower.next_lot, kind, shower.next_turn);
    shower.next_lot = -1;
    ++shower.arrived;
    ++added;
  }
  return added;
}

}  // namespace vibrosow
