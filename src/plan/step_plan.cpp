#include "plan/step_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/elastic_shell.hpp"
#include "contact/hertz.hpp"
#include "grains/clump_discs.hpp"
#include "grains/size_distribution.hpp"
#include "plan/contact_parameters.hpp"
#include "plan/effects.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {
namespace {

constexpr double contacts_of_a_packed_grain = 6;
constexpr double packed_to_pair = std::numbers::sqrt3;  // of frequencies, and of damping ratios
constexpr double longest_travel = 0.1;                  // radii a step
constexpr double wanted_friction_step = 0.5;            // dt lambda that a chosen step keeps to
constexpr double allowed_energy_growth = 1.01;  // of a free vibration under RK2 over the whole run, in amplitude

/// Grains as contacts see them: of a lot with a distribution its smallest and its largest, of a clump its discs.
std::vector<GrainKind> touching_kinds(const Scene& scene) {
  std::vector<GrainKind> touching;
  const std::vector<GrainKind> kinds = grain_kinds(scene, true);
  for (std::size_t l = 0; l < scene.lots.size(); ++l) {
    const SeedLot& lot = scene.lots[l];
    const bool scatter = lot.sizes.kind != SizeDistribution::Kind::single;
    std::vector<double> sizes{1};
    if (scatter) sizes = {1, least_size(lot), most_size(lot)};
    for (const double size : sizes) {
      const GrainKind whole = sized_kind(lot, scene.contact.law, kinds[l], size);
      if (lot.discs.empty()) touching.push_back(whole);
      for (const ClumpDisc& disc : lot.discs) touching.push_back(kind_of_disc(whole, disc, size, scene.contact.law));
    }
  }
  return touching;
}

/// Two bodies that meet: a grain and another, or a wall (curvature and inverse mass 0).
struct Meeting {
  double stiffness, inverse_mass, compression_per_overlap;
};

Meeting meeting(const Scene& scene, const GrainKind& a, double compliance, double curvature, double inverse_mass) {
  const double fraction = a.compliance / (a.compliance + compliance);
  const double stiffness = scene.contact.law == Law::elastic_shell
                               ? ElasticShell::stiffness(a.compliance, compliance, 1 / a.radius, curvature)
                               : Hertz::stiffness(a.compliance, compliance, 1 / a.radius, curvature);
  return {stiffness, a.inverse_mass + inverse_mass, fraction / a.radius};
}

Meeting on_wall(const Scene& scene, const GrainKind& a) {
  return meeting(scene, a, contact_parameters(scene).wall_compliance, 0, 0);
}

Meeting with_grain(const Scene& scene, const GrainKind& a, const GrainKind& b) {
  return meeting(scene, a, b.compliance, 1 / b.radius, b.inverse_mass);
}

/// Largest overlap (m) of an elastic impact at `speed`: V / omega, or (5 M V^2 / (4 k))^(2/5).
double impact_overlap(const Scene& scene, const Meeting& m, double speed) {
  if (scene.contact.law == Law::elastic_shell) return speed / std::sqrt(m.stiffness * m.inverse_mass);
  return std::pow(1.25 * speed * speed / (m.stiffness * m.inverse_mass), 0.4);
}

/// How long it lasts, s: half a period, or 2.943275 d_max / V (2 sqrt(pi) Gamma(7/5) / Gamma(9/10)).
double impact_duration(const Scene& scene, const Meeting& m, double speed) {
  if (scene.contact.law == Law::elastic_shell) return std::numbers::pi / std::sqrt(m.stiffness * m.inverse_mass);
  return 2.943275 * impact_overlap(scene, m, speed) / speed;
}

/// Overlap (m) under a force at rest.
double static_overlap(const Scene& scene, const Meeting& m, double force) {
  return scene.contact.law == Law::elastic_shell ? force / m.stiffness : std::pow(force / m.stiffness, 2.0 / 3);
}

/// Slope of the force, N/m, at an overlap.
double slope(const Scene& scene, const Meeting& m, double overlap) {
  return scene.contact.law == Law::elastic_shell ? m.stiffness : 1.5 * m.stiffness * std::sqrt(overlap);
}

double mean_diameter(const Scene& scene) {
  double mean = 0;
  for (const SeedLot& lot : scene.lots) mean += lot.number_fraction * size_moment(lot, 1) * lot.diameter;
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

/// Force over mass of a lot's smallest seed, against that of a seed of mean diameter in a bed of mean seeds: a fraction
/// of the bed's pressure that goes with its diameter, over its own mass. 1 for single sizes.
double load_of_smallest(const Scene& scene) {
  double largest = 1;
  for (const SeedLot& lot : scene.lots)
    largest =
        std::max(largest, mean_mass(lot) / lot.mass / std::pow(least_size(lot), lot.shape == Shape::ball ? 2 : 1));
  return largest;
}

double largest(const std::vector<SurfaceParameters>& surfaces, double SurfaceParameters::*value) {
  double most = 0;
  for (const SurfaceParameters& s : surfaces) most = std::max(most, s.*value);
  return most;
}

/// lambda = nu F_n / (v_s m_t) of what is made continuous by the slip speed, 1/s, with F_n the weight of the layers
/// above; sliding friction that is no spring, and a constant rolling torque. 0: there is nothing of the kind.
double friction_rate(const Scene& scene) {
  const EffectSet effects = effects_of(scene);
  const ContactParameters parameters = contact_parameters(scene);
  double per_spin = 2;  // m r^2 / I, of a clump at its furthest point
  for (const SeedLot& lot : scene.lots)
    per_spin = std::max(per_spin, lot.shape == Shape::ball    ? 2.5
                                  : lot.shape == Shape::clump ? 0.25 * lot.diameter * lot.diameter / lot.gyration2
                                                              : 2);
  const double per_surface = effects.rotation ? 1 + per_spin : 1;  // 1 / (m m_t), of one grain
  const double layers = deepest_fill(scene), weight = standard_gravity * weight_factor(scene);
  const auto rate = [&](const std::vector<SurfaceParameters>& surfaces) {
    double most = 0;
    if (!effects.tangential_spring) most = per_surface * largest(surfaces, &SurfaceParameters::friction);
    if (effects.rolling == Rolling::constant_torque)
      most = std::max(most, per_spin * largest(surfaces, &SurfaceParameters::rolling_friction));
    return most;
  };
  const double on_wall = rate(parameters.walls) * layers * weight;
  const double in_bed = rate(parameters.pairs) * std::max(layers - 1, 1.0) * weight * 2;
  return std::max(on_wall, in_bed) * load_of_smallest(scene) / scene.contact.slip_speed;
}

/// Speed that a grain can reach: twice the vessel's, or the fall from the highest edge to the counting line.
double predicted_speed(const Scene& scene) {
  double speed = 0, drop = scene.tray.height;
  for (const Vessel& vessel : vessels_of(scene)) {
    speed = std::max(speed, 2 * largest_speed(vessel));
    drop = std::max(drop, vessel.origin.y() + vessel.height);
    if (vessel.rain) drop = std::max(drop, vessel.origin.y() + vessel.rain->height);
  }
  return std::max(speed, std::sqrt(2 * standard_gravity * (drop + scene.run.count_below)));
}

/// Speed of impact at which Hertz' law is looked at, m/s; the elastic shell's contact does not depend on it.
double impact_speed(const Scene& scene) {
  return scene.numerics.impact_speed.value_or(predicted_speed(scene));
}

/// Stiffness of a grain against sliding and turning, over its stiffness against the normal.
double tangential_stiffening(const Scene& scene, const GrainKind& kind) {
  const EffectSet effects = effects_of(scene);
  if (!effects.tangential_spring) return 1;
  double ratio = 0;
  const ContactParameters parameters = contact_parameters(scene);
  for (const auto* surfaces : {&parameters.pairs, &parameters.walls})
    for (const SurfaceParameters& s : *surfaces) ratio = std::max(ratio, s.tangential_ratio);
  if (scene.contact.law != Law::elastic_shell) ratio /= 1.5;  // of the slope, not the secant
  const double spin = effects.rotation ? kind.radius * kind.radius * kind.inverse_inertia / kind.inverse_mass : 0;
  return std::max(1.0, ratio * (1 + spin));
}

/// How much easier than its mass a clump yields where it is touched off its centre: 1 + arm^2 / gyration^2, the
/// largest.
double lever(const Scene& scene) {
  double largest = 1;
  for (const SeedLot& lot : scene.lots)
    for (const ClumpDisc& disc : lot.discs)
      largest = std::max(largest, 1 + (disc.x * disc.x + disc.y * disc.y) / lot.gyration2);
  return largest;
}

/// Largest frequency (rad/s) of a grain among six others: omega^2 = 6 k / m; for equal grains in elastic shells
/// sqrt(3 g / eps). Hertz' stiffness is taken at the larger of the overlaps of impact and of the layers' weight.
double largest_frequency(const Scene& scene, const std::vector<GrainKind>& kinds) {
  double largest2 = 0;
  for (const GrainKind& light : kinds)
    for (const GrainKind& other : kinds) {
      const Meeting m = with_grain(scene, light, other);
      const double weight = deepest_fill(scene) * weight_factor(scene) * other.mass * standard_gravity;
      const double overlap = std::max(impact_overlap(scene, m, impact_speed(scene)), static_overlap(scene, m, weight));
      largest2 = std::max(largest2, contacts_of_a_packed_grain * slope(scene, m, overlap) * light.inverse_mass *
                                        tangential_stiffening(scene, light));
    }
  return std::sqrt(largest2 * lever(scene));
}

/// The shortest elastic contact of any two grains or a grain on a wall, s.
double shortest_contact(const Scene& scene, const std::vector<GrainKind>& kinds) {
  const double speed = impact_speed(scene);
  double shortest = 1e300;
  for (const GrainKind& a : kinds) {
    shortest = std::min(shortest, impact_duration(scene, on_wall(scene, a), speed));
    for (const GrainKind& b : kinds)
      shortest = std::min(shortest, impact_duration(scene, with_grain(scene, a, b), speed));
  }
  return shortest;
}

/// Damping ratios of a pair on all surfaces, the smallest and the largest; `omega` is that of a packed grain.
std::pair<double, double> damping_ratios(const Scene& scene, double omega) {
  double smallest = 1e300, largest = 0;
  const ContactParameters parameters = contact_parameters(scene);
  for (const auto* surfaces : {&parameters.pairs, &parameters.walls})
    for (const SurfaceParameters& s : *surfaces) {
      const double ratio =
          scene.contact.law == Law::hertz_viscous ? packed_to_pair * s.damping_rate / (2 * omega) : s.damping_ratio;
      smallest = std::min(smallest, ratio), largest = std::max(largest, ratio);
    }
  return {smallest, largest};
}

double lightest(const std::vector<GrainKind>& kinds) {
  return std::min_element(kinds.begin(), kinds.end(),
                          [](const GrainKind& a, const GrainKind& b) { return a.mass < b.mass; })
      ->mass;
}

StepLimit contact_limit(const Scene& scene, const std::vector<GrainKind>& kinds) {
  const double omega = largest_frequency(scene, kinds);
  const auto [smallest_zeta, zeta] = damping_ratios(scene, omega);
  const double stable = (std::sqrt(1 + zeta * zeta) - zeta) / omega;  // half of the explicit schemes' 2 (...) / omega
  const std::string what =
      scene.contact.law == Law::elastic_shell ? "the shell's vibration" : "the contact's vibration";
  if (scene.numerics.integrator == Integrator::velocity_verlet) return {what + " (Verlet)", stable};
  // Eigenvalues of a step of a damped oscillator with alpha_0 = 3/16: none is larger than 1 for omega dt up to 0.327
  // where it is hardly damped, and up to 0.081 / zeta where it is; a packed grain's ratio is sqrt(3) times a pair's.
  if (scene.numerics.integrator == Integrator::gear5)
    return {what + " (Gear)", std::min(0.327, 0.081 / (packed_to_pair * zeta)) / omega};
  // A free vibration grows by omega^4 dt^3 / 8 per second; half of what drag and damping take may be used up.
  const double taken = 0.5 * (scene.contact.drag / (2 * lightest(kinds)) + smallest_zeta * omega);
  const double growth = taken + std::log(allowed_energy_growth) / scene.run.duration;
  return {"the growth of " + what + " (RK2)", std::min(stable, std::cbrt(8 * growth / std::pow(omega, 4)))};
}

}  // namespace

StepPlan plan_step(const Scene& scene) {
  const std::vector<GrainKind> kinds = touching_kinds(scene);
  StepPlan plan{};
  plan.contact_duration = shortest_contact(scene, kinds);
  plan.limits.push_back(contact_limit(scene, kinds));
  double wanted = plan.contact_duration / scene.numerics.steps_per_contact;
  if (const double rate = friction_rate(scene); rate > 0) {
    const double factor = scene.numerics.integrator == Integrator::velocity_verlet ? 1 : 2;
    plan.limits.push_back({"friction below the slip speed", factor / rate});
    wanted = std::min(wanted, wanted_friction_step / rate);
  }
  plan.limits.push_back(
      {"a grain's travel in one step", longest_travel * smallest_radius(scene.lots) / predicted_speed(scene)});
  if (scene.contact.drag > 0) {
    plan.limits.push_back({"drag", lightest(kinds) / scene.contact.drag});
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
      scene.numerics.where.or_key("numerics.dt"), plan.dt, plan.longest_safe, plan.bound_by);
}

PredictedCompression predict_compression(const Scene& scene) {
  PredictedCompression predicted{};
  predicted.layers = deepest_fill(scene);
  for (const Vessel& vessel : vessels_of(scene))
    predicted.impact_speed = std::max(predicted.impact_speed, 2 * largest_speed(vessel));
  for (const GrainKind& kind : touching_kinds(scene)) {
    const Meeting wall = on_wall(scene, kind);
    const double weight = predicted.layers * weight_factor(scene) * kind.mass * standard_gravity;
    const double at_rest = static_overlap(scene, wall, weight);
    predicted.static_compression = std::max(predicted.static_compression, at_rest * wall.compression_per_overlap);
    predicted.static_overlap =
        std::max(predicted.static_overlap, static_overlap(scene, with_grain(scene, kind, kind), weight) / kind.radius);
    predicted.impact_compression =
        std::max(predicted.impact_compression,
                 impact_overlap(scene, wall, predicted.impact_speed) * wall.compression_per_overlap);
  }
  // The shell's compression goes with eps at rest and with its root at impact.
  const double at_rest = scene.guard.warn_compression / predicted.static_compression;
  const double at_impact = scene.guard.warn_compression / std::max(predicted.impact_compression, 1e-300);
  predicted.stiff_enough = scene.contact.shell_compression * std::min(at_rest, at_impact * at_impact);
  return predicted;
}

}  // namespace vibrosow
