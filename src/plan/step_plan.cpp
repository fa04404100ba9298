#include "plan/step_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "grains/clump_discs.hpp"
#include "plan/bed_vibration.hpp"
#include "plan/meeting.hpp"
#include "portable_math/functions.hpp"
#include "scene/clump_shape.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "scene/side_contacts_3d.hpp"

namespace vibrosow {
namespace {

constexpr double longest_travel = 0.1;          // radii a step
constexpr double allowed_energy_growth = 1.01;  // of a free vibration under RK2 over the whole run, in amplitude

double largest(const std::vector<SurfaceParameters>& surfaces, double SurfaceParameters::*value) {
  double most = 0;
  for (const SurfaceParameters& s : surfaces) most = std::max(most, s.*value);
  return most;
}

/// dt lambda of friction below its slip speed, lambda = nu F_n / (v_s m_t).
struct FrictionStep {
  double longest;  // from the eigenvalues of a step: beyond it, what should slow down grows
  double wanted;   // that a chosen step keeps to: a grain bears on several others at once, and their rates add up
};
FrictionStep friction_step(Integrator integrator) {
  switch (integrator) {
    case Integrator::velocity_verlet:  // it swings from 2 on, as friction takes its own contact's change into account
    case Integrator::rk2_midpoint:
      return {2, 0.5};
    case Integrator::gear5:
      return {0.16, 0.04};
  }
  throw std::logic_error("a scheme without a limit for friction");
}

Eigen::Vector3d gyration2_of(const SeedLot& lot) {
  return {lot.gyration2_x, lot.gyration2_y, lot.gyration2};
}

/// m r^2 / I, the largest, of a clump at its furthest point; 0 where nothing turns.
double spin_factor(const StepBasis& basis) {
  double largest = 0;
  for (std::size_t l = 0; l < basis.seeds.size(); ++l) {
    const GrainKind& seed = basis.seeds[l];
    const SeedLot& lot = basis.scene.lots[l];
    if (seed.inverse_inertia == 0) continue;
    largest =
        std::max(largest, is_solid_clump(lot) ? furthest_yield(lot.discs, gyration2_of(lot))
                                              : seed.radius * seed.radius * seed.inverse_inertia / seed.inverse_mass);
  }
  return largest;
}

/// lambda of what is made continuous by the slip speed, 1/s, with F_n the weight of the layers above; sliding friction
/// that is no spring, and a constant rolling torque. 0: there is nothing of the kind.
double friction_rate(const StepBasis& basis) {
  const EffectSet& effects = basis.effects;
  const double per_spin = spin_factor(basis), per_surface = 1 + per_spin;  // 1 / (m m_t), of one grain
  const double layers = basis.loads.layers, weight = standard_gravity * basis.loads.weight_factor;
  const auto rate = [&](const std::vector<SurfaceParameters>& surfaces) {
    double most = 0;
    if (!effects.tangential_spring) most = per_surface * largest(surfaces, &SurfaceParameters::friction);
    if (effects.rolling == Rolling::constant_torque)
      for (const auto torque : {&SurfaceParameters::rolling_friction, &SurfaceParameters::twisting_friction})
        most = std::max(most, per_spin * largest(surfaces, torque));
    return most;
  };
  const double rate_on_wall = rate(basis.contacts.walls) * layers * weight;
  const double rate_in_bed = rate(basis.contacts.pairs) * std::max(layers - 1, 1.0) * weight * 2;
  return std::max(rate_on_wall, rate_in_bed) * basis.loads.load_of_smallest / basis.scene.contact.slip_speed;
}

/// How the seeds of a lot lean on what they touch; a round one on a point. Sides that lie within the depth a run bears
/// unwarned count as flat.
SideContacts side_contacts_of(const StepBasis& basis, std::size_t lot) {
  const GrainKind& seed = basis.seeds[lot];
  const std::vector<ClumpDisc>& discs = basis.scene.lots[lot].discs;
  if (discs.empty()) return {1, 1, 1, seed.radius * seed.radius * seed.inverse_inertia / seed.inverse_mass};
  std::vector<double> weights;
  for (const ClumpDisc& disc : discs)
    weights.push_back(on_wall(basis, kind_of_disc(seed, disc, 1, basis.law)).stiffness);
  const double stiffest = *std::ranges::max_element(weights);
  for (double& weight : weights) weight /= stiffest;
  const SeedLot& clump = basis.scene.lots[lot];
  const double depth = basis.scene.guard.warn_relative_overlap;
  SideContacts contacts = is_solid_clump(clump) ? side_contacts_3d(discs, weights, gyration2_of(clump), depth)
                                                : side_contacts(discs, weights, clump.gyration2, depth);
  if (seed.inverse_inertia == 0) contacts.turning = 0;
  return contacts;
}

/// The most over all lots.
SideContacts most_side_contacts(const StepBasis& basis) {
  SideContacts most;
  for (std::size_t lot = 0; lot < basis.seeds.size(); ++lot) {
    const SideContacts side = side_contacts_of(basis, lot);
    most.discs = std::max(most.discs, side.discs);
    most.at_a_tip = std::max(most.at_a_tip, side.at_a_tip);
    most.on_a_side = std::max(most.on_a_side, side.on_a_side);
    most.turning = std::max(most.turning, side.turning);
  }
  return most;
}

/// A way in which a packed bed vibrates fastest: its frequency, and its damping ratio at the most and least dissipative
/// surface.
struct Mode {
  std::string what;
  double omega;  // rad/s
  double most_damped, least_damped;
  double room_to_spare;  // fraction of the limit of stability that a step may take
};

/// The steepest slope of any contact over the lighter grain's mass, 1/s2.
double slope_per_mass(const StepBasis& basis) {
  double largest = 0;
  for (const GrainKind& light : basis.touching)
    for (const GrainKind& other : basis.touching)
      largest =
          std::max(largest, steepest_slope(basis, with_grain(basis, light, other), other.mass) * light.inverse_mass);
  return largest;
}

/// Largest ratio of tangential to normal stiffness (slopes), 0 without tangential springs.
double spring_ratio(const StepBasis& basis) {
  if (!basis.effects.tangential_spring) return 0;
  return std::max(largest(basis.contacts.pairs, &SurfaceParameters::tangential_ratio),
                  largest(basis.contacts.walls, &SurfaceParameters::tangential_ratio)) /
         basis.law.slope_over_secant;
}

/// Damping ratios of a pair on all surfaces, the smallest and the largest; `omega` is the pair's.
std::pair<double, double> damping_ratios(const StepBasis& basis, double omega) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const auto* surfaces : {&basis.contacts.pairs, &basis.contacts.walls})
    for (const SurfaceParameters& s : *surfaces) {
      const double ratio = basis.law.damping_ratio(s, omega);
      smallest = std::min(smallest, ratio), largest = std::max(largest, ratio);
    }
  return {smallest, largest};
}

/// Grains against each other. (In 2D the largest eigenvalues are 6 + 2 rho, at the middle of the zone's edge,
/// and 9/2 (1 + rho), at its corner.) Without springs sqrt(3 g / eps), in 3D sqrt(4 g / eps), for equal grains in
/// elastic shells. Clumps touched at their tips yield more easily, and are damped alike.
Mode translation(const StepBasis& basis, double slope_over_mass, const SideContacts& sides) {
  const ClosestPacking bed = closest_packing(basis.scene.space);
  const double omega =
      std::sqrt((bed.normal + bed.tangential * spring_ratio(basis)) * sides.at_a_tip * slope_over_mass);
  const double over_pair = std::sqrt(0.5 * bed.normal * sides.at_a_tip);  // of frequencies, and of damping ratios
  const auto [least, most] = damping_ratios(basis, omega / over_pair);
  return {basis.law.material == LawMaterial::shell ? "the shell's vibration" : "the contact's vibration", omega,
          over_pair * most, over_pair * least, 0.5};
}

/// Clumps in a stack, flat side on flat side, each against its two neighbours: omega^2 = 4 k / m times what the discs
/// of a side add up to.
Mode stack(const StepBasis& basis, double slope_over_mass, const SideContacts& sides) {
  const double over_pair = std::sqrt(2 * sides.on_a_side);
  const double pair = std::sqrt(2 * slope_over_mass);
  const auto [least, most] = damping_ratios(basis, pair);
  return {"the vibration of flat sides", over_pair * pair, over_pair * most, over_pair * least, 0.5};
}

/// All grains turning alike, each against its neighbours, damped by the tangential dashpots, tau times the normal ones:
/// the pair's ratio times tau sqrt(x / rho). A clump's neighbours touch all the discs of a side.
Mode rotation(const StepBasis& basis, double slope_over_mass, const SideContacts& sides) {
  const double x = closest_packing(basis.scene.space).turning * sides.turning;
  const double rho = spring_ratio(basis);
  const auto [least, most] = damping_ratios(basis, std::sqrt(2 * slope_over_mass));
  const double damped = basis.scene.contact.tangential_damping * std::sqrt(x / rho);
  return {"the spin's vibration", std::sqrt(2 * x * rho * slope_over_mass), damped * most, damped * least, 0.75};
}

double lightest(const std::vector<GrainKind>& kinds) {
  return std::min_element(kinds.begin(), kinds.end(),
                          [](const GrainKind& a, const GrainKind& b) { return a.mass < b.mass; })
      ->mass;
}

/// The longest step that keeps a mode stable, with room to spare.
StepLimit vibration_limit(const StepBasis& basis, const Mode& mode) {
  const double zeta = mode.most_damped, omega = mode.omega;
  // Eigenvalues of a step of a damped oscillator. Gear's scheme with alpha_0 = 3/16: none is larger than 1 for omega dt
  // up to 0.327 where it is hardly damped, and up to 0.081 / zeta where it is.
  if (basis.scene.numerics.integrator == Integrator::gear5)
    return {mode.what + " (Gear)", std::min(0.327, 0.081 / zeta) / omega};
  // The midpoint scheme is stable where it is damped beyond 2 (sqrt(1 + zeta^2) - zeta); a free vibration grows by
  // omega^4 dt^3 / 8 per second: half of what drag and damping take may be used up.
  const double taken = 0.5 * (basis.scene.contact.drag / (2 * lightest(basis.touching)) + mode.least_damped * omega);
  const double growth = taken + portable_math::log(allowed_energy_growth) / basis.scene.run.duration;
  const double stable = mode.room_to_spare * 2 * (std::sqrt(1 + zeta * zeta) - zeta) / omega;
  return {"the growth of " + mode.what + " (RK2)",
          std::min(stable, portable_math::cbrt(8 * growth / (omega * omega * omega * omega)))};
}

constexpr double never_again = std::numeric_limits<double>::infinity();  // s

/// The shortest time (s) from one turning point of a table's column to the next. Swings of less than 1 % of all that it
/// moves through do not count. The first and the last may be parts of a swing: they count as long as a whole one lasts.
double shortest_swing(const std::vector<double>& times, const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  const double range = high - low, least = 0.01 * range;
  if (!(range > 0)) return never_again;
  std::vector<std::size_t> turns = {0};  // the last of them may still move on
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double from_last = values[k] - values[turns.back()];
    if (turns.size() == 1 ? from_last == 0 : from_last * (values[turns.back()] - values[turns[turns.size() - 2]]) > 0)
      turns.back() = k;
    else if (std::abs(from_last) > least)
      turns.push_back(k);
  }
  double shortest = never_again;
  for (std::size_t n = 1; n < turns.size(); ++n) {
    const double swing = std::abs(values[turns[n]] - values[turns[n - 1]]);
    const double part = n == 1 || n + 1 == turns.size() ? std::min(2.0, range / swing) : 1;
    shortest = std::min(shortest, part * (times[turns[n]] - times[turns[n - 1]]));
  }
  return shortest;
}

/// Of the fastest component of a motion, s; infinity where nothing moves. Of a table twice its shortest swing.
double shortest_period(const Vessel& vessel) {
  if (!vessel.motion || !moves(*vessel.motion)) return never_again;
  const auto of_harmonic = [](const HarmonicMotion& m) {
    return m.amplitude != 0 && m.frequency != 0 ? 1 / std::abs(m.frequency) : never_again;
  };
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&*vessel.motion)) return of_harmonic(*harmonic);
  if (const auto* rocking = std::get_if<RockingMotion>(&*vessel.motion)) return 1 / std::abs(rocking->frequency);
  if (const auto* turning = std::get_if<TurningMotion>(&*vessel.motion))
    return 2 * std::numbers::pi / std::abs(turning->angular_velocity);
  if (const auto* sum = std::get_if<SumMotion>(&*vessel.motion)) {
    double shortest = never_again;
    for (const HarmonicMotion& component : sum->components) shortest = std::min(shortest, of_harmonic(component));
    return shortest;
  }
  const TableMotion& table = std::get<TableMotion>(*vessel.motion);
  double swing = never_again;
  for (const std::vector<double>* column : {&table.x, &table.y, &table.angle, &table.z})
    if (!column->empty()) swing = std::min(swing, shortest_swing(table.times, *column));
  return 2 * swing;
}

/// Walls move in steps as seeds do: a wall that goes to and fro within a few of them strikes at no speed it ever has.
void add_limit_of_drive(const Scene& scene, std::vector<StepLimit>& limits) {
  constexpr double steps_per_period = 20;
  double shortest = shortest_period(scene.tray);
  if (scene.hopper) shortest = std::min(shortest, shortest_period(*scene.hopper));
  if (std::isfinite(shortest))
    limits.push_back(
        {fmt::format("{:g} steps in a period of the motion", steps_per_period), shortest / steps_per_period});
}

/// Of schemes without a bed of their own.
void add_limits_of_modes(const StepBasis& basis, const SideContacts& sides, std::vector<StepLimit>& limits) {
  const double slope_over_mass = slope_per_mass(basis);
  limits.push_back(vibration_limit(basis, translation(basis, slope_over_mass, sides)));
  if (basis.effects.clumps) limits.push_back(vibration_limit(basis, stack(basis, slope_over_mass, sides)));
  if (basis.effects.tangential_spring && basis.effects.rotation)
    limits.push_back(vibration_limit(basis, rotation(basis, slope_over_mass, sides)));
}

}  // namespace

double shortest_contact(const StepBasis& basis) {
  const auto duration = [&](const Meeting& m) {
    return basis.law.impact_duration(m.stiffness, m.inverse_mass, impact_speed(basis));
  };
  double shortest = std::numeric_limits<double>::infinity();
  for (const GrainKind& a : basis.touching) {
    shortest = std::min(shortest, duration(on_wall(basis, a)));
    for (const GrainKind& b : basis.touching) shortest = std::min(shortest, duration(with_grain(basis, a, b)));
  }
  return shortest;
}

StepPlan plan_step(const StepBasis& basis) {
  const Numerics& numerics = basis.scene.numerics;
  StepPlan plan{};
  plan.contact_duration = shortest_contact(basis);
  const SideContacts sides = most_side_contacts(basis);
  if (numerics.integrator == Integrator::velocity_verlet)
    plan.limits.push_back({"the bed's vibration (Verlet)", longest_stable_step(basis, packed_bed(basis))});
  else
    add_limits_of_modes(basis, sides, plan.limits);
  double wanted = plan.contact_duration / numerics.steps_per_contact;
  const FrictionStep friction = friction_step(numerics.integrator);
  if (const double rate = friction_rate(basis); rate > 0) {
    plan.limits.push_back({"friction below the slip speed", friction.longest / rate});
    wanted = std::min(wanted, friction.wanted / rate);
  }
  plan.limits.push_back(
      {"a grain's travel in one step", longest_travel * basis.smallest_radius / basis.loads.grain_speed});
  if (const double drag = basis.scene.contact.drag; drag > 0)
    plan.limits.push_back({"drag", lightest(basis.touching) / drag});
  add_limit_of_drive(basis.scene, plan.limits);
  const StepLimit& tightest = *std::ranges::min_element(plan.limits, {}, &StepLimit::dt);
  plan.longest_safe = tightest.dt;
  plan.bound_by = tightest.reason;
  plan.dt = numerics.dt.value_or(std::min(wanted, plan.longest_safe));
  plan.steepest_rolling = friction.wanted / plan.dt;
  plan.steepest_sliding = plan.steepest_rolling / (1 + spin_factor(basis)) / sides.discs;
  plan.too_long = plan.dt > plan.longest_safe;
  plan.steps = std::llround(std::ceil(basis.scene.run.duration / plan.dt * (1 - 1e-12)));
  return plan;
}

std::optional<std::string> step_refused(const Numerics& numerics, const StepPlan& plan) {
  if (!plan.too_long || numerics.allow_long_step) return std::nullopt;
  return fmt::format(
      "{}: {:.4g} s is too long, the longest safe step is {:.4g} s (bound by {}); numerics.allow_long_step = true "
      "runs it all the same, and marks the result",
      numerics.where.or_key("numerics.dt"), plan.dt, plan.longest_safe, plan.bound_by);
}

PredictedOverlap predict_overlap(const StepBasis& basis) {
  PredictedOverlap predicted{};
  predicted.layers = basis.loads.layers;
  predicted.impact_speed = std::max(2 * basis.loads.vessel_speed, basis.loads.fall_speed);
  for (const GrainKind& kind : basis.touching) {
    const Meeting wall = on_wall(basis, kind), pair = with_grain(basis, kind, kind);
    const double weight = predicted.layers * basis.loads.weight_factor * kind.mass * standard_gravity;
    const double impact = basis.law.impact_overlap(wall.stiffness, wall.inverse_mass, predicted.impact_speed);
    predicted.overlap_at_rest = std::max(predicted.overlap_at_rest,
                                         basis.law.static_overlap(wall.stiffness, weight) * wall.relative_per_overlap);
    predicted.pair_overlap_at_rest =
        std::max(predicted.pair_overlap_at_rest, basis.law.static_overlap(pair.stiffness, weight) / kind.radius);
    predicted.overlap_at_impact = std::max(predicted.overlap_at_impact, impact * wall.relative_per_overlap);
  }
  // The overlap goes with eps at rest and with its root at impact.
  const double warn = basis.scene.guard.warn_relative_overlap;
  const double at_rest = warn / predicted.overlap_at_rest;
  const double at_impact = warn / std::max(predicted.overlap_at_impact, 1e-300);
  predicted.stiff_enough = basis.scene.contact.shell_compression * std::min(at_rest, at_impact * at_impact);
  return predicted;
}

}  // namespace vibrosow
