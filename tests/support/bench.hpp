#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "grains/turning_clump.hpp"
#include "scene/clump_shape.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {

/// A scene's model that runs with this step (s), as if it were safe; with the effects it calls for, or with more.
inline Model prepare_with_step(Scene scene, double dt, const std::optional<EffectSet>& effects = std::nullopt) {
  scene.numerics.dt = dt;
  Model model = prepare(scene, effects);
  model.step.too_long = false;
  return model;
}

/// The same of a model's scene and effects.
inline Model with_step(const Model& model, double dt) {
  return prepare_with_step(model.scene, dt, model.effects);
}

inline constexpr Space both_spaces[] = {Space::two_dimensional, Space::three_dimensional};

/// Names the instances of a test that is made for both spaces.
inline constexpr auto named_by_space = [](const auto& info) -> std::string {
  return info.param == Space::two_dimensional ? "plane" : "space";
};

// A grain's place, velocity and spin, whichever space it is in.
inline Eigen::Vector3d place_of(const Grains& g, std::size_t i) {
  return {g.x[i], g.y[i], g.is_3d ? g.z[i] : 0};
}
inline Eigen::Vector3d velocity_of(const Grains& g, std::size_t i) {
  return {g.vx[i], g.vy[i], g.is_3d ? g.vz[i] : 0};
}
inline Eigen::Vector3d turning_of(const Grains& g, std::size_t i) {
  if (!g.rotation) return Eigen::Vector3d::Zero();
  if (!g.is_3d) return {0, 0, g.omega[i]};
  const Vector3 spin = spin_of(g, i);
  return {spin.x, spin.y, spin.z};
}
inline void set_turning(Grains& g, std::size_t i, const Eigen::Vector3d& spin) {
  if (!g.rotation) return;
  if (g.is_3d)
    set_spin(g, i, {spin.x(), spin.y(), spin.z()});
  else
    g.omega[i] = spin.z();
}

/// N, of its contacts.
inline Eigen::Vector3d force_on(const Simulation& run, std::size_t i) {
  if (!run.grains().is_3d) return {run.field().forces()[i].fx, run.field().forces()[i].fy, 0};
  const GrainVector& force = run.field().forces_3d()[i];
  return {force.x, force.y, force.z};
}

/// A bench for tests: a few grains placed by hand in a wide box, with or without gravity. In 3D they are balls.
///
///     Bench bench;
///     bench.scene.contact.seed.restitution = 0.5;
///     bench.place(0, 0, 1, 0).place(0.01, 0, -1, 0);
///     Simulation& run = bench.start(1e-6);
class Bench {
 public:
  static constexpr double radius = 4e-3;  // m
  static constexpr double mass = 0.6e-3;  // kg
  static constexpr double pi = 3.14159265358979323846;

  Scene scene;
  Eigen::Vector2d gravity{0, 0};

  explicit Bench(Space space = Space::two_dimensional) {
    scene.title = "bench";
    scene.space = space;
    if (space == Space::three_dimensional) scene.tray.depth = 1;
    scene.lots = {{"grain", 2 * radius, mass, space == Space::two_dimensional ? Shape::disc : Shape::ball, 1.0}};
    scene.contact.shell_compression = 1e-4;
    scene.tray.name = "tray";
    scene.tray.length = 1;
    scene.tray.height = 1;
    scene.run.duration = 1;
  }

  /// A grain at a place of the lab (m) with a velocity (m/s) and spin (rad/s); a clump turned by `angle` (rad). The box
  /// spans 0..1 m in x and y, and in 3D in z, of which it is in the middle.
  Bench& place(double x, double y, double vx = 0, double vy = 0, double omega = 0, int lot = 0, double angle = 0) {
    placed_.push_back({{x, y, 0.5}, {vx, vy, 0}, {0, 0, omega}, {angle, {}}, lot});
    return *this;
  }

  /// The same anywhere in 3D; in the plane x and y count, and the spin about z.
  Bench& place(const Eigen::Vector3d& at, const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero(),
               const Eigen::Vector3d& spin = Eigen::Vector3d::Zero(), int lot = 0,
               const Orientation& orientation = {}) {
    placed_.push_back({at, velocity, spin, {0, orientation}, lot});
    return *this;
  }

  /// Lot 0 becomes a ball of Hertz' law (Pa, kg/m3, m); walls are rigid.
  Bench& hertz_ball(double youngs_modulus, double poisson_ratio, double density, double ball_radius) {
    const double ball_mass = 4.0 / 3 * pi * density * ball_radius * ball_radius * ball_radius;
    scene.lots[0] = {"ball", 2 * ball_radius, ball_mass, Shape::ball, 1.0};
    scene.contact.law = Law::hertz;
    scene.contact.youngs_modulus = youngs_modulus;
    scene.contact.poisson_ratio = poisson_ratio;
    return *this;
  }

  /// Another lot, a rigid set of discs (m) about their common centre of mass.
  Bench& add_clump(std::vector<ClumpDisc> discs, double clump_mass) {
    discs = about_centre_of_mass(std::move(discs));
    SeedLot lot{"clump", 2 * holding_radius(discs), clump_mass, Shape::clump, 1.0};
    lot.gyration2 = plate_of(discs).gyration2;
    lot.discs = std::move(discs);
    scene.lots.push_back(std::move(lot));
    return *this;
  }

  /// Starts with the effects the scene calls for, or with more.
  Simulation& start(double dt, std::optional<EffectSet> effects = std::nullopt, NeighbourMargins margins = {}) {
    Model model = prepare_with_step(scene, dt, effects);
    model.gravity = gravity;
    Grains grains = no_grains(model);
    for (const Placed& p : placed_) {
      grains.add(p.at, p.velocity, p.lot, grains.kinds[static_cast<std::size_t>(p.lot)], p.turned);
      set_turning(grains, grains.size() - 1, p.spin);
    }
    simulation_ = std::make_unique<Simulation>(model, starting_state(model, 1, std::move(grains)),
                                               ComputeOptions{.margins = margins});
    return *simulation_;
  }

  /// How long an elastic contact lasts, of two grains or of one on a wall: pi sqrt(eps / g).
  double contact_time() const {  // s
    return pi * std::sqrt(scene.contact.shell_compression * radius / standard_gravity);
  }

 private:
  struct Placed {
    Eigen::Vector3d at, velocity, spin;
    Turn turned;
    int lot;
  };
  std::vector<Placed> placed_;
  std::unique_ptr<Simulation> simulation_;
};

/// Hertz' law for an impact of reduced mass m* (kg) and stiffness k (N/m^(3/2)) at `speed` (m/s): the largest overlap
/// (5 m* V^2 / (4 k))^(2/5), the force there, and the duration 2 sqrt(pi) Gamma(7/5) / Gamma(9/10) of it over V.
struct HertzImpact {
  double overlap, force, duration;  // m, N, s

  HertzImpact(double reduced_mass, double stiffness, double speed)
      : overlap(std::pow(1.25 * reduced_mass * speed * speed / stiffness, 0.4)),
        force(stiffness * std::pow(overlap, 1.5)),
        duration(2 * std::sqrt(Bench::pi) * std::tgamma(1.4) / std::tgamma(0.9) * overlap / speed) {}
};

/// A wall where a grain hits it: a point of it (m), and unit vectors out of it and along it, in whose plane the impact
/// is.
struct HitWall {
  Eigen::Vector3d point{0.5, 0, 0.5}, normal{0, 1, 0}, along{1, 0, 0};

  Eigen::Vector3d across() const { return along.cross(normal); }  // the axis about which the grain is turned
};

/// What an impact left behind and how it went. The force counts as ended where it fell to zero, by linear
/// interpolation between steps.
struct ImpactResult {
  double vx, vy, omega;   // of the grain that hit, afterwards: along the wall, out of it, about the axis across
  double aside;           // m/s, what of its velocity, and of its spin times its radius, is not in the impact's plane
  double other_vx;        // of the grain that was hit
  double peak_force;      // N, normal to the touching surfaces
  double peak_overlap;    // m
  double duration;        // s, from touch to parting
  double force_duration;  // s, from touch to the force's end
};

/// Runs from before the touch to `after` steps past the parting. `overlap(run)` may be negative; `force(run)` is the
/// repulsion on grain 0.
template <class Overlap, class Force>
ImpactResult run_impact(Simulation& run, double dt, const HitWall& axes, Overlap overlap, Force force,
                        std::int64_t most_steps = 2000000) {
  ImpactResult result{};
  double touched = -1, parted = -1, ended = -1, overlap_before = overlap(run), force_before = 0;
  const auto crossing = [&](double before, double now) { return run.time() - dt * now / (now - before); };
  for (std::int64_t step = 0; parted < 0; ++step) {
    if (step > most_steps || !run.step()) throw std::runtime_error("the impact did not end");
    const double d = overlap(run), f = force(run);
    if (overlap_before <= 0 && d > 0) touched = crossing(overlap_before, d);
    if (overlap_before > 0 && d <= 0) parted = crossing(overlap_before, d);
    if (ended < 0 && force_before > 0 && f <= 0) ended = run.time();
    result.peak_force = std::max(result.peak_force, f);
    result.peak_overlap = std::max(result.peak_overlap, d);
    overlap_before = d, force_before = f;
  }
  const Grains& g = run.grains();
  const Eigen::Vector3d velocity = velocity_of(g, 0), spin = turning_of(g, 0), across = axes.across();
  result.vx = velocity.dot(axes.along), result.vy = velocity.dot(axes.normal), result.omega = spin.dot(across);
  result.aside = std::hypot(velocity.dot(across), g.kind(0).radius * spin.cross(across).norm());
  result.other_vx = g.size() > 1 ? velocity_of(g, 1).dot(axes.along) : 0;
  result.duration = parted - touched;
  result.force_duration = ended - touched;
  return result;
}

/// A grain of lot 0 comes down on a wall with these velocities (m/s) and spin (rad/s). It starts `phase` steps above.
inline ImpactResult wall_impact(Bench& bench, double down, double along, double dt, double spin = 0,
                                double phase = 2.37, const HitWall& wall = {}) {
  const double r = 0.5 * bench.scene.lots[0].diameter;
  bench.place(wall.point + (r + phase * down * dt) * wall.normal, along * wall.along - down * wall.normal,
              spin * wall.across());
  Simulation& run = bench.start(dt);
  return run_impact(
      run, dt, wall, [&](const Simulation& s) { return r - wall.normal.dot(place_of(s.grains(), 0) - wall.point); },
      [&](const Simulation& s) { return wall.normal.dot(force_on(s, 0)); });
}

/// Grain 0 (lot 0) flies at `speed` (m/s) in a direction, along x, into grain 1 (of `lot`), which is at rest.
inline ImpactResult head_on_impact(Bench& bench, double speed, int lot, double dt, double phase = 2.37,
                                   const Eigen::Vector3d& direction = Eigen::Vector3d::UnitX()) {
  const double reach = 0.5 * (bench.scene.lots[0].diameter + bench.scene.lots[static_cast<std::size_t>(lot)].diameter);
  const Eigen::Vector3d middle(0.5, 0.5, 0.5), nowhere = Eigen::Vector3d::Zero();
  bench.place(middle, speed * direction)
      .place(middle + reach * direction + (phase * speed * dt) * direction, nowhere, nowhere, lot);
  Simulation& run = bench.start(dt);
  return run_impact(
      run, dt, {middle, direction.unitOrthogonal(), direction},
      [&](const Simulation& s) { return reach - direction.dot(place_of(s.grains(), 1) - place_of(s.grains(), 0)); },
      [&](const Simulation& s) { return -direction.dot(force_on(s, 0)); });
}

}  // namespace vibrosow
