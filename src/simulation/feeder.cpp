#include "simulation/feeder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grains/size_distribution.hpp"
#include "simulation/counter.hpp"
#include "simulation/vessel_motion.hpp"

namespace vibrosow {
namespace {

/// Grains of one vessel, in its own frame.
struct Inside {
  std::vector<Eigen::Vector2d> at;
  std::vector<double> radius;
};

Inside grains_inside(const Vessel& vessel, const Eigen::Vector2d& displacement, const Grains& grains) {
  Inside inside;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (!is_inside(vessel, displacement, grains.x[i], grains.y[i])) continue;
    inside.at.push_back(in_vessel_frame(vessel, displacement, {grains.x[i], grains.y[i]}));
    inside.radius.push_back(grains.kind(i).radius);
  }
  return inside;
}

/// Lowest height at which a grain of `radius` at `x` clears all grains below it.
double surface(const Inside& inside, double x, double radius) {
  constexpr double clearance = 1.01;
  double height = radius;
  for (std::size_t k = 0; k < inside.at.size(); ++k) {
    const double reach = clearance * (radius + inside.radius[k]), dx = x - inside.at[k].x();
    if (std::abs(dx) < reach) height = std::max(height, inside.at[k].y() + std::sqrt(reach * reach - dx * dx));
  }
  return height;
}

bool is_kept(const Vessel& vessel) {
  return vessel.fill && vessel.fill->keep;
}

}  // namespace

Feeder::Feeder(const Scene& scene, std::uint64_t random_seed)
    : lots_(scene.lots),
      law_(scene.contact.law),
      random_(~random_seed),  // a stream of its own, apart from the packing's
      feeds_(is_kept(scene.tray) || (scene.hopper && is_kept(*scene.hopper))) {}

int Feeder::draw_lot() {
  if (lots_.size() == 1) return 0;
  double rest = random_.uniform();
  for (std::size_t lot = 0; lot + 1 < lots_.size(); ++lot) {
    rest -= lots_[lot].number_share;
    if (rest < 0) return static_cast<int>(lot);
  }
  return static_cast<int>(lots_.size()) - 1;
}

void Feeder::note_waiting(const Vessel& vessel, int waiting, double time) {
  constexpr double noted_share = 0.25;
  if (!warning_.empty() || waiting <= noted_share * vessel.fill->count) return;
  warning_ = fmt::format(
      "{}.fill.keep falls behind: {} of {} seeds missing at {:.4g} s, for want of room below the walls' top; seeds "
      "laid "
      "from rest follow no faster",
      vessel.name, waiting, vessel.fill->count, time);
}

int Feeder::top_up(Grains& grains, const Walls& walls, double time) {
  int added = 0;
  for (std::size_t v = 0; v < walls.vessels().size(); ++v) {
    const Vessel& vessel = walls.vessels()[v];
    if (!is_kept(vessel)) continue;
    Inside inside = grains_inside(vessel, walls.displacement()[v], grains);
    const Eigen::Vector2d velocity = vessel_velocity(vessel, time);
    const int missing = vessel.fill->count - static_cast<int>(inside.at.size());
    int waiting = 0;
    for (int k = 0; k < missing; ++k) {
      const int lot = draw_lot();
      const SeedLot& seeds = lots_[static_cast<std::size_t>(lot)];
      const double size = draw_size(seeds, random_), angle = draw_angle(seeds, random_);
      const double radius = 0.5 * size * seeds.diameter;
      const double x = random_.uniform(radius, vessel.length - radius);
      const double y = surface(inside, x, radius);
      if (y + radius > vessel.height) {
        ++waiting;
        continue;
      }
      inside.at.emplace_back(x, y);
      inside.radius.push_back(radius);
      const Eigen::Vector2d lab = in_lab_frame(vessel, walls.displacement()[v], {x, y});
      const GrainKind kind = sized_kind(seeds, law_, grains.kinds[static_cast<std::size_t>(lot)], size);
      grains.add(lab.x(), lab.y(), velocity.x(), velocity.y(), lot, kind, angle);
      ++added;
    }
    note_waiting(vessel, waiting, time);
  }
  return added;
}

}  // namespace vibrosow
