#pragma once

#include <optional>
#include <utility>

#include "simulation/simulation.hpp"

namespace vibrosow {

/// A bench for tests: a few grains placed by hand in a wide box, with or without gravity.
///
///     Bench bench;
///     bench.scene.contact.seed.restitution = 0.5;
///     bench.place(0, 0, 1, 0).place(0.01, 0, -1, 0);
///     Simulation& run = bench.start(1e-6);
class Bench {
 public:
  static constexpr double radius = 4e-3;  // m
  static constexpr double mass = 0.6e-3;  // kg

  Scene scene;
  Eigen::Vector2d gravity{0, 0};

  Bench() {
    scene.title = "bench";
    scene.lots = {{"grain", 2 * radius, mass, Shape::disc, 1.0}};
    scene.contact.shell_compression = 1e-4;
    scene.tray.name = "tray";
    scene.tray.length = 1;
    scene.tray.height = 1;
    scene.run.duration = 1;
  }

  /// A grain at a place of the lab (m) with a velocity (m/s) and spin (rad/s). The box spans 0..1 m in x and y.
  Bench& place(double x, double y, double vx = 0, double vy = 0, double omega = 0, int lot = 0) {
    placed_.push_back({x, y, vx, vy, omega, lot});
    return *this;
  }

  /// Starts with the effects the scene calls for, or with more.
  Simulation& start(double dt, std::optional<EffectSet> effects = std::nullopt, NeighbourMargins margins = {}) {
    const EffectSet set = effects.value_or(effects_of(scene));
    Grains grains(grain_kinds(scene, scene.contact.rotation), set.unequal, set.rotation);
    for (const Placed& p : placed_) {
      grains.add(p.x, p.y, p.vx, p.vy, p.lot);
      if (set.rotation) grains.omega.back() = p.omega;
    }
    simulation_ = std::make_unique<Simulation>(
        scene, std::move(grains),
        SimulationSetup{.dt = dt, .gravity = gravity, .effects = set, .margins = margins, .insisted_on_step = false});
    return *simulation_;
  }

  /// How long an elastic contact lasts, of two grains or of one on a wall: pi sqrt(eps / g).
  double contact_time() const {  // s
    return 3.14159265358979323846 * std::sqrt(scene.contact.shell_compression * radius / standard_gravity);
  }

 private:
  struct Placed {
    double x, y, vx, vy, omega;
    int lot;
  };
  std::vector<Placed> placed_;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace vibrosow
