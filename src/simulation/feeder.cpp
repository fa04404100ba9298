#include "simulation/feeder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grains/places.hpp"
#include "grains/size_distribution.hpp"
#include "grains/turned_discs.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "simulation/counter.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

/// The vessel's frame, or of one that turns over and over that at rest: the heap lies where its floor was.
Pose upright_frame(const Vessel& vessel, const Pose& pose) {
  return turns_over(vessel) ? Pose{} : pose;
}

}  // namespace

/// Grains of one vessel, in its own frame; in the plane z is 0.
struct Feeder::Inside {
  bool is_3d = false;
  int grains = 0;
  std::vector<Eigen::Vector3d> at;
  std::vector<double> radius;
  std::vector<char> lies;  // in the heap; otherwise it is falling

  /// In a periodic vessel with its images to either side.
  void add(const Vessel& vessel, const Eigen::Vector3d& own, double own_radius, bool in_heap) {
    const int along = vessel.sides == Sides::periodic ? 1 : 0;
    const int across = is_3d && vessel.front_and_back == Sides::periodic ? 1 : 0;
    for (int i = -along; i <= along; ++i)
      for (int k = -across; k <= across; ++k) {
        const double depth = across == 0 ? 0 : *vessel.depth;
        at.emplace_back(own.x() + i * vessel.length, own.y(), own.z() + k * depth);
        radius.push_back(own_radius);
        lies.push_back(in_heap ? 1 : 0);
      }
  }
};

/// Those whose centre is in the vessel count (`SeedPlaces::counts_in`), or in an image of it; others that reach into
/// it, at an outlet or over its edge, are in the way.
Feeder::Inside Feeder::grains_inside(std::size_t v, const Walls& walls, const Grains& grains,
                                     const std::vector<char>& touching) const {
  Inside inside;
  inside.is_3d = grains.is_3d;
  for (std::size_t image = v; image < walls.vessels().size(); ++image) {
    const Vessel& vessel = walls.vessels()[image];
    if (vessel.name != walls.vessels()[v].name) continue;
    const Pose pose = upright_frame(vessel, walls.poses()[image]);
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const Eigen::Vector3d own = point_in_vessel(vessel, pose, grains.place(i));
      const double reach = grains.kind(i).radius + model_.largest_diameter;
      if (own.x() < -reach || own.x() > vessel.length + reach || own.y() < -reach || own.y() > vessel.height + reach)
        continue;
      if (grains.is_3d && (own.z() < -reach || own.z() > *vessel.depth + reach)) continue;
      if (is_inside(vessel, pose, grains, i) && places_.counts_in(grains.place(i), image, walls)) ++inside.grains;
      inside.add(vessel, own, grains.kind(i).radius, touching[i] != 0);
    }
  }
  return inside;
}

namespace {

/// What a ball of `radius` over one place of the floor meets of the grains inside, by height.
class Column {
 public:
  template <class Inside>
  Column(const Inside& inside, const FloorPlace& place, double radius) : heap_(radius) {
    constexpr double clearance = 1.01;
    for (std::size_t k = 0; k < inside.at.size(); ++k) {
      const double reach = clearance * (radius + inside.radius[k]), dx = place.x() - inside.at[k].x();
      if (std::abs(dx) >= reach) continue;
      const double dz = place.y() - inside.at[k].z(), left2 = reach * reach - dx * dx - dz * dz;
      if (left2 <= 0) continue;
      const double y = inside.at[k].y(), half = std::sqrt(left2);
      if (inside.lies[k])
        heap_ = std::max(heap_, y + half);
      else
        falling_.emplace_back(y - half, y + half);
    }
    std::sort(falling_.begin(), falling_.end());
  }

  /// Lowest height of its centre above the heap, from `least` on, at which it is clear of all grains: between those
  /// that are still falling if there is room, so that a heap which sinks fast can be fed fast.
  double lowest(double least) const {
    double height = std::max(least, heap_);
    for (const auto& [low, high] : falling_)
      if (low < height) height = std::max(height, high);
    return height;
  }

 private:
  double heap_;                                     // m
  std::vector<std::pair<double, double>> falling_;  // m, heights taken by grains in the air
};

/// Seeds that have come up to `time`.
std::int64_t arrivals(const Rain& rain, double time) {
  const double lasted = std::min(time, rain.stop) - rain.start;
  return lasted > 0 ? static_cast<std::int64_t>(std::floor(lasted * rain.rate * (1 + 1e-12))) : 0;
}

}  // namespace

Feeder::Feeder(const Model& model, FeederState& state) : model_(model), state_(state), places_(model) {
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

const SeedLot& Feeder::lot_of(const DrawnSeed& seed) const {
  return model_.scene.lots[static_cast<std::size_t>(seed.lot)];
}

DrawnSeed Feeder::draw(Random& random) const {
  DrawnSeed seed{.lot = draw_lot(random)};
  seed.size = draw_size(lot_of(seed), random);
  return seed;
}

double Feeder::radius_of(const DrawnSeed& seed) const {
  return 0.5 * seed.size * lot_of(seed).diameter;
}

bool Feeder::belongs(const DrawnSeed& seed, const Eigen::Vector3d& at, std::size_t v, const Walls& walls) const {
  return places_.belong(at, half_width(lot_of(seed), seed.size), v, walls);
}

void Feeder::note_waiting(std::size_t v, int waiting, double time, bool stands) {
  const Vessel& vessel = model_.vessels[v];
  constexpr double noted_fraction = 0.25;
  if (!state_.warning.empty() || waiting <= noted_fraction * vessel.fill->count) return;
  const std::string why = stands ? "for want of room below the walls' top" + places_.unseen_ways(v)
                                 : fmt::format("as the {} was tipped over", vessel.name);
  state_.warning = fmt::format("{}.fill.keep falls behind: {} of {} seeds missing at {:.4g} s, {}", vessel.name,
                               waiting, vessel.fill->count, time, why);
}

std::optional<double> Feeder::free_height(const Inside& inside, const FloorPlace& place, const DrawnSeed& seed,
                                          std::size_t v, const Walls& walls) const {
  constexpr double least_rise = 0.01, rise_outside = 0.25;  // of the radius
  const Vessel& vessel = walls.vessels()[v];
  const Pose frame = upright_frame(vessel, walls.poses()[v]);
  const double radius = radius_of(seed);
  const Column column(inside, place, radius);
  for (double y = column.lowest(radius); y + radius <= vessel.height;) {
    const Eigen::Vector3d at = point_in_lab(vessel, frame, {place.x(), y, place.y()});
    const double depth = places_.depth_in_walls(at, radius, walls);
    const bool clear = depth <= most_placing_overlap * radius;
    if (clear && belongs(seed, at, v, walls)) return y;
    // Nothing nearer is clear of the wall, or beyond the wall that shuts the place off.
    y = column.lowest(y + (clear ? std::max(-depth, rise_outside * radius) : std::max(depth, least_rise * radius)));
  }
  return std::nullopt;
}

void Feeder::put(const DrawnSeed& seed, const Eigen::Vector3d& at, const Eigen::Vector3d& velocity, std::size_t v,
                 const Walls& walls, Grains& grains) {
  const GrainKind& mean = model_.kinds[static_cast<std::size_t>(seed.lot)];
  grains.add(at, velocity, seed.lot, sized_kind(lot_of(seed), *model_.law, mean, seed.size), seed.turned);
  if (fault_) return;
  const std::size_t i = grains.size() - 1;
  if (const auto fault = places_.fault(grains, i, v, walls)) fault_ = placing_fault(model_, grains, i, *fault);
}

int Feeder::top_up(Grains& grains, const std::vector<char>& touching, const Walls& walls, double time) {
  int added = 0;
  for (std::size_t v = 0; v < walls.vessels().size(); ++v) {
    const Vessel& vessel = walls.vessels()[v];
    if (!is_kept(vessel)) continue;
    const Pose pose = walls.poses()[v], frame = upright_frame(vessel, pose);
    const PoseRate rate = walls.rate(v, time);
    Inside inside = grains_inside(v, walls, grains, touching);
    const int missing = vessel.fill->count - inside.grains;
    if (!stands(vessel, pose)) {
      note_waiting(v, missing, time, false);
      continue;
    }
    int waiting = 0;
    std::optional<DrawnSeed>& next = state_.missing[v];
    for (int k = 0; k < missing; ++k) {
      if (!next) next = draw(state_.random);
      next->turned = draw_turn(lot_of(*next), state_.random);
      const double radius = radius_of(*next);
      const FloorPlace place = grains.is_3d ? random_place(vessel, radius, state_.random)
                                            : FloorPlace(state_.random.uniform(radius, vessel.length - radius), 0);
      const std::optional<double> y = free_height(inside, place, *next, v, walls);
      if (!y) {
        ++waiting;
        continue;
      }
      const Eigen::Vector3d own(place.x(), *y, place.y());
      inside.add(vessel, own, radius, false);
      const Eigen::Vector3d at = point_in_lab(vessel, frame, own);
      put(*next, at, point_velocity(vessel, pose, rate, at), v, walls, grains);
      next.reset();
      ++added;
    }
    note_waiting(v, waiting, time, true);
  }
  return added;
}

int Feeder::rain(Grains& grains, const Walls& walls, double time) {
  int added = 0;
  for (std::size_t v = 0; v < walls.vessels().size(); ++v)
    if (walls.vessels()[v].rain) added += rain(v, grains, walls, time);
  return added;
}

int Feeder::rain(std::size_t v, Grains& grains, const Walls& walls, double time) {
  const Vessel& vessel = walls.vessels()[v];
  const Rain& rain = *vessel.rain;
  const Pose frame = steady_frame(vessel, walls.poses()[v]);
  FeederState::Shower& shower = state_.showers[v];
  if (!stands(vessel, frame)) {  // what is due meanwhile does not come
    const std::int64_t due = arrivals(rain, time);
    shower.withheld += due - shower.arrived, shower.arrived = due;
    return 0;
  }
  const double over = rain.height - vessel.height;
  const Eigen::Vector3d aside =
      over > 0 ? aside_while_rising(vessel, frame, over) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const std::int64_t waiting = arrivals(rain, time) - shower.arrived;
  int added = 0;
  for (std::int64_t k = 0; k < waiting; ++k) {
    if (!shower.next) {
      shower.next = draw(shower.random);
      shower.next->turned = draw_turn(lot_of(*shower.next), shower.random);
    }
    const double radius = radius_of(*shower.next);
    const double margin = vessel.sides == Sides::walls ? std::min(radius, 0.5 * vessel.length) : 0;
    const double from = std::clamp(rain.from, margin, vessel.length - margin);
    const double to = std::clamp(rain.to, margin, vessel.length - margin);
    const FloorPlace place = grains.is_3d ? random_place(vessel, radius, from, to, shower.random)
                                          : FloorPlace(shower.random.uniform(from, to), 0);
    const Eigen::Vector3d own(place.x(), rain.height, place.y());
    const Eigen::Vector3d at = point_in_lab(vessel, frame, own + aside);
    const bool clear = places_.is_clear_of_grains(at, radius, grains) &&
                       places_.depth_in_walls(at, radius, walls) <= most_placing_overlap * radius;
    if (!clear || !belongs(*shower.next, at, v, walls)) continue;
    put(*shower.next, at, Eigen::Vector3d::Zero(), v, walls, grains);
    shower.next.reset();
    ++shower.arrived;
    ++added;
  }
  if (waiting - added > shower.most_waiting) shower.most_waiting = waiting - added, shower.most_waiting_at = time;
  return added;
}

std::vector<std::string> Feeder::warnings(double time) const {
  constexpr double noted_fraction = 0.05;
  std::vector<std::string> warnings;
  if (!state_.warning.empty()) warnings.push_back(state_.warning);
  for (std::size_t v = 0; v < state_.showers.size(); ++v) {
    const std::optional<Rain>& rain = model_.vessels[v].rain;
    if (!rain) continue;
    const FeederState::Shower& shower = state_.showers[v];
    if (shower.withheld > 0)
      warnings.push_back(fmt::format("{}.rain: {} of {} seeds did not come, as the {} was tipped over",
                                     model_.vessels[v].name, shower.withheld, arrivals(*rain, time),
                                     model_.vessels[v].name));
    const auto is_much = [due = arrivals(*rain, time)](std::int64_t waiting) {
      return waiting > 1 && static_cast<double>(waiting) > noted_fraction * static_cast<double>(due);
    };
    const std::int64_t waiting = arrivals(*rain, time) - shower.arrived;
    if (is_much(waiting))
      warnings.push_back(fmt::format("{}.rain falls behind: {} of {} seeds still wait at {:.4g} s, for want of room{}",
                                     model_.vessels[v].name, waiting, arrivals(*rain, time), time,
                                     places_.unseen_ways(v)));
    else if (is_much(shower.most_waiting))
      warnings.push_back(
          fmt::format("{}.rain falls behind: at {:.4g} s {} of {} seeds waited for want of room, and they came later{}",
                      model_.vessels[v].name, shower.most_waiting_at, shower.most_waiting,
                      arrivals(*rain, shower.most_waiting_at), places_.unseen_ways(v)));
  }
  return warnings;
}

}  // namespace vibrosow
