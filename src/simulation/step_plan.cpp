#include "simulation/step_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/elastic_shell.hpp"
#include "contact/kernels.hpp"
#include "simulation/vessel_motion.hpp"
#include "simulation/walls.hpp"

namespace vibrosow {
namespace {

constexpr double contacts_of_a_packed_grain = 6;
constexpr double longest_travel = 0.1;          // radii a step
constexpr double wanted_friction_step = 0.5;    // dt lambda that a chosen step keeps to
constexpr double allowed_energy_growth = 1.01;  // of a free vibration under RK2 over the whole run, in amplitude

/// Largest frequency (rad/s) of a grain among six others: omega^2 = 6 k / m; for equal grains sqrt(3 g / eps).
double largest_frequency(const std::vector<GrainKind>& kinds) {
  double largest2 = 0;
  for (const GrainKind& light : kinds)
    for (const GrainKind& other : kinds)
      largest2 =
          std::max(largest2, contacts_of_a_packed_grain * ElasticShell::stiffness(light.compliance, other.compliance) *
                                 light.inverse_mass);
  return std::sqrt(largest2);
}

/// Half a period of the stiffest, lightest pair or grain on a wall, s.
double shortest_contact(const std::vector<GrainKind>& kinds) {
  double largest2 = 0;
  for (const GrainKind& a : kinds) {
    largest2 = std::max(largest2, a.inverse_mass / a.compliance);
    for (const GrainKind& b : kinds)
      largest2 =
          std::max(largest2, ElasticShell::stiffness(a.compliance, b.compliance) * (a.inverse_mass + b.inverse_mass));
  }
  return std::numbers::pi / std::sqrt(largest2);
}

double mean_diameter(const Scene& scene) {
  double mean = 0;
  for (const SeedLot& lot : scene.lots) mean += lot.number_share * lot.diameter;
  return mean;
}

/// At most: all that rains while the run lasts stays, up to the vessel's height.
double seeds_of(const Scene& scene, const Vessel& vessel) {
  const double filled = vessel.fill ? vessel.fill->count : 0;
  if (!vessel.rain) return filled;
  const double rained =
      vessel.rain->rate * std::max(0.0, std::min(vessel.rain->stop, scene.run.duration) - vessel.rain->start);
  const double diameter = mean_diameter(scene);
  return std::max(filled, std::min(filled + rained, vessel.length * vessel.height / (diameter * diameter)));
}

double deepest_fill(const Scene& scene) {
  double layers = 1;
  for (const Vessel& vessel : vessels_of(scene))
    if (vessel.fill || vessel.rain)
      layers = std::max(layers, std::ceil(seeds_of(scene, vessel) * mean_diameter(scene) / vessel.length));
  return layers;
}

/// Weight of a grain in a vertically shaken vessel over its weight at rest.
double weight_factor(const Scene& scene) {
  double largest = 0;
  for (const Vessel& vessel : vessels_of(scene)) largest = std::max(largest, largest_vertical_acceleration(vessel));
  return 1 + largest / standard_gravity;
}

/// lambda = nu F_n / (v_s m_t) of the regularised friction, 1/s, with F_n the weight of the layers above.
double friction_rate(const Scene& scene) {
  const Contact& contact = scene.contact;
  const bool ball =
      std::any_of(scene.lots.begin(), scene.lots.end(), [](const SeedLot& l) { return l.shape == Shape::ball; });
  const bool rotation = effects_of(scene).rotation;
  const double per_surface = !rotation ? 1 : ball ? 3.5 : 3;  // 1 / (m m_t), of one grain
  const double layers = deepest_fill(scene), weight = standard_gravity * weight_factor(scene);
  const double on_wall = contact.wall.friction * layers * weight * per_surface;
  const double in_bed = contact.seed.friction * std::max(layers - 1, 1.0) * weight * 2 * per_surface;
  return std::max(on_wall, in_bed) / contact.slip_speed;
}

/// Speed that a grain can reach: twice the vessel's, or the fall from the highest edge to the counting line.
double foretold_speed(const Scene& scene) {
  double speed = 0, drop = scene.tray.height;
  for (const Vessel& vessel : vessels_of(scene)) {
    speed = std::max(speed, 2 * largest_speed(vessel));
    drop = std::max(drop, vessel.origin.y() + vessel.height);
    if (vessel.rain) drop = std::max(drop, vessel.origin.y() + vessel.rain->height);
  }
  return std::max(speed, std::sqrt(2 * standard_gravity * (drop + scene.run.count_below)));
}

StepLimit shell_limit(const Scene& scene, const std::vector<GrainKind>& kinds) {
  const double omega = largest_frequency(kinds);
  const ContactParameters parameters = contact_parameters(scene.contact);
  const double zeta = std::max(parameters.seed.damping_ratio, parameters.wall.damping_ratio);
  const double stable = (std::sqrt(1 + zeta * zeta) - zeta) / omega;  // half of the explicit schemes' 2 (...) / omega
  if (scene.numerics.integrator == Integrator::velocity_verlet) return {"the shell's vibration (Verlet)", stable};
  double lightest = 1 / kinds.front().inverse_mass;
  for (const GrainKind& kind : kinds) lightest = std::min(lightest, kind.mass);
  // A free vibration grows by omega^4 dt^3 / 8 per second; half of what drag and damping take may be used up.
  const double smallest_zeta = std::min(parameters.seed.damping_ratio, parameters.wall.damping_ratio);
  const double taken = 0.5 * (scene.contact.drag / (2 * lightest) + smallest_zeta * omega);
  const double growth = taken + std::log(allowed_energy_growth) / scene.run.duration;
  return {"the growth of the shell's vibration (RK2)", std::min(stable, std::cbrt(8 * growth / std::pow(omega, 4)))};
}

double smallest_radius(const Scene& scene) {
  double smallest = scene.lots.front().diameter;
  for (const SeedLot& lot : scene.lots) smallest = std::min(smallest, lot.diameter);
  return 0.5 * smallest;
}

}  // namespace

StepPlan plan_step(const Scene& scene) {
  const std::vector<GrainKind> kinds = grain_kinds(scene, true);
  StepPlan plan{};
  plan.contact_duration = shortest_contact(kinds);
  plan.limits.push_back(shell_limit(scene, kinds));
  double wanted = plan.contact_duration / scene.numerics.steps_per_contact;
  if (effects_of(scene).friction) {
    const double rate = friction_rate(scene);
    const double factor = scene.numerics.integrator == Integrator::velocity_verlet ? 1 : 2;
    plan.limits.push_back({"friction below the slip speed", factor / rate});
    wanted = std::min(wanted, wanted_friction_step / rate);
  }
  plan.limits.push_back(
      {"a grain's travel in one step", longest_travel * smallest_radius(scene) / foretold_speed(scene)});
  if (scene.contact.drag > 0) {
    double lightest = kinds.front().mass;
    for (const GrainKind& kind : kinds) lightest = std::min(lightest, kind.mass);
    plan.limits.push_back({"drag", lightest / scene.contact.drag});
  }
  const auto tightest = std::min_element(plan.limits.begin(), plan.limits.end(),
                                         [](const StepLimit& a, const StepLimit& b) { return a.dt < b.dt; });
  plan.longest_safe = tightest->dt;
  plan.bound_by = tightest->reason;
  plan.dt = scene.numerics.dt.value_or(std::min(wanted, plan.longest_safe));
  plan.too_long = plan.dt > plan.longest_safe;
  plan.steps = std::llround(std::ceil(scene.run.duration / plan.dt * (1 - 1e-12)));
  return plan;
}

std::optional<std::string> step_refused(const Scene& scene, const StepPlan& plan) {
  if (!plan.too_long || scene.numerics.allow_long_step) return std::nullopt;
  return fmt::format(
      "{}: {:.4g} s is too long, the longest safe step is {:.4g} s (bound by {}); numerics.allow_long_step = true "
      "runs it all the same, and marks the result",
      scene.numerics.where.empty() ? "numerics.dt" : scene.numerics.where, plan.dt, plan.longest_safe, plan.bound_by);
}

ForetoldCompression foretell_compression(const Scene& scene) {
  ForetoldCompression foretold{};
  const double compression = scene.contact.shell_compression;
  foretold.layers = deepest_fill(scene);
  foretold.static_compression = foretold.layers * compression * weight_factor(scene);
  foretold.static_overlap = 2 * foretold.static_compression;
  for (const Vessel& vessel : vessels_of(scene))
    foretold.impact_speed = std::max(foretold.impact_speed, 2 * largest_speed(vessel));
  // d = V / omega with omega^2 = g / eps
  foretold.impact_compression =
      foretold.impact_speed * std::sqrt(compression / (standard_gravity * smallest_radius(scene)));
  const double at_rest = scene.guard.warn_compression / foretold.static_compression;
  const double at_impact = scene.guard.warn_compression / std::max(foretold.impact_compression, 1e-300);
  foretold.stiff_enough = compression * std::min(at_rest, at_impact * at_impact);
  return foretold;
}

}  // namespace vibrosow
