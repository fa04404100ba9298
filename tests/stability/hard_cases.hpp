#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"

namespace vibrosow {

inline constexpr Integrator every_scheme[] = {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5};

/// With what a hard case is run.
struct Setting {
  Space space = Space::two_dimensional;
  Integrator scheme = Integrator::velocity_verlet;
  Law law = Law::elastic_shell;

  bool is_3d() const { return space == Space::three_dimensional; }
  std::string name_of_space() const { return is_3d() ? "space" : "plane"; }
  std::string name_of_scheme() const {
    return scheme == Integrator::velocity_verlet ? "verlet" : scheme == Integrator::rk2_midpoint ? "rk2" : "gear";
  }
  std::string name_of_law() const {
    return law == Law::elastic_shell ? "shell" : law == Law::hertz ? "hertz" : "viscous";
  }
  std::string name() const { return name_of_space() + "_" + name_of_scheme() + "_" + name_of_law(); }

  Bench bench() const {
    Bench made(space);
    choose(made.scene);
    return made;
  }
  /// How deep a bench's grain presses into a wall with so many times its weight, m.
  double overlap_at_rest(const Scene& scene, double weights) const {
    if (law == Law::elastic_shell) return weights * scene.contact.shell_compression * Bench::radius;
    return std::pow(weights * Bench::mass * standard_gravity / hertz_stiffness(scene), 2.0 / 3);
  }
  /// How deep a bench's grain presses into a wall that it hits elastically at this speed, m.
  double overlap_on_wall(const Scene& scene, double speed) const {
    const Contact& c = scene.contact;
    if (law == Law::elastic_shell) return speed * std::sqrt(c.shell_compression * Bench::radius / standard_gravity);
    return HertzImpact(Bench::mass, hertz_stiffness(scene), speed).overlap;
  }
  /// How deep a bench's grain is pressed into a wall by that energy (J), m.
  double overlap_of_energy(const Scene& scene, double energy) const {
    return overlap_on_wall(scene, std::sqrt(2 * energy / Bench::mass));
  }
  static double hertz_stiffness(const Scene& scene) {  // N/m^(3/2), on a wall
    const Contact& c = scene.contact;
    return 4.0 / 3 * c.youngs_modulus / (1 - c.poisson_ratio * c.poisson_ratio) * std::sqrt(Bench::radius);
  }
  /// Hertz' grains as stiff as the shells are at some 1 m/s, damped to about half of that speed.
  void choose(Scene& scene) const {
    scene.contact.law = law;
    scene.contact.youngs_modulus = 2e7;
    scene.contact.damping_rate = 1000;
    scene.numerics.integrator = scheme;
    scene.numerics.steps_per_contact = usual_steps_per_contact(scheme);
  }
};
inline std::ostream& operator<<(std::ostream& out, const Setting& setting) {
  return out << setting.name();
}

inline std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const Space space : both_spaces)
    for (const Integrator scheme : every_scheme)
      for (const Law law : {Law::elastic_shell, Law::hertz, Law::hertz_viscous}) all.push_back({space, scheme, law});
  return all;
}

template <class Wanted>
std::vector<Setting> settings_where(Wanted wanted) {
  std::vector<Setting> some = settings();
  std::erase_if(some, [&](const Setting& setting) { return !wanted(setting); });
  return some;
}
inline std::vector<Setting> settings_3d() {
  return settings_where([](const Setting& setting) { return setting.is_3d(); });
}

inline constexpr auto made_by_numerics = "energy made by the numerics";

inline constexpr auto named_by_setting = [](const auto& info) { return info.param.name(); };

/// How long a grain touches a wall that it hits at `speed`, s.
inline double contact_time(const Setting& setting, const Bench& bench, double speed) {
  if (setting.law == Law::elastic_shell) return bench.contact_time();
  return 2.943275 * setting.overlap_on_wall(bench.scene, speed) / speed;
}

/// Closest packed grains in a tray of this length, in 3D as deep.
inline Scene tray_scene(const Setting& setting, int grains, double length) {
  Scene scene = setting.bench().scene;
  scene.tray.length = length;
  if (setting.is_3d()) scene.tray.depth = length;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.tray.fill = Fill{grains, Packing::hexagonal, 1e-3, false};
  return scene;
}

inline double total_energy(Simulation& run, const Eigen::Vector2d& gravity) {
  return kinetic_energy(run.grains()) + potential_energy(run.grains(), gravity) + run.field().elastic_energy();
}

}  // namespace vibrosow
