#include "simulation/force_field.hpp"

#include <algorithm>
#include <chrono>

namespace vibrosow {
namespace {

double largest_diameter(const Scene& scene) {
  double largest = 0;
  for (const SeedLot& lot : scene.lots) largest = std::max(largest, lot.diameter);
  return largest;
}

Motion motion_of(const Grains& grains) {
  return {grains.x.data(), grains.y.data(), grains.vx.data(), grains.vy.data(), grains.omega.data()};
}

}  // namespace

ForceField::ForceField(const Scene& scene, const KernelSet& kernels, NeighbourMargins margins)
    : walls_(vessels_of(scene)),
      neighbours_(walls_.vessels(), largest_diameter(scene), margins),
      parameters_(contact_parameters(scene.contact)),
      kernels_(kernels) {}

void ForceField::evaluate(const Grains& grains, double time, ContactCensus& census) {
  const auto started = std::chrono::steady_clock::now();
  walls_.place(time);
  neighbours_.update(grains, walls_);
  const auto found = std::chrono::steady_clock::now();
  forces_.fx.assign(grains.size(), 0);
  forces_.fy.assign(grains.size(), 0);
  forces_.torque.assign(grains.omega.size(), 0);
  census.wall_power = 0;
  const Motion at = motion_of(grains);
  kernels_.pair(grains, at, neighbours_.pairs(), parameters_, forces_, census);
  kernels_.wall(grains, at, neighbours_.near_walls(), walls_.placed(), parameters_, forces_, census);
  neighbour_time_ += std::chrono::duration<double>(found - started).count();
  force_time_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - found).count();
}

void ForceField::remove_wall(std::size_t wall) {
  walls_.remove(wall);
  neighbours_.remove_wall(static_cast<int>(wall));
}

double ForceField::elastic_energy(const Grains& grains) const {
  return kernels_.elastic_energy(grains, motion_of(grains), neighbours_.pairs(), neighbours_.near_walls(),
                                 walls_.placed());
}

}  // namespace vibrosow
