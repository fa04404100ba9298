#include "simulation/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "grains/turning_clump.hpp"
#include "portable_math/functions.hpp"
#include "simulation/seed_places.hpp"

namespace vibrosow {
namespace {

/// Share of the energy in play that the numerics may make before it is worth a word.
constexpr double energy_warning = 0.05;

}  // namespace

namespace {

double mass_of(const Grains& grains, std::size_t i) {
  return grains.polydisperse ? grains.mass[i] : grains.kinds.front().mass;
}

double energy_of_travel(const Grains& grains, std::size_t i) {
  const double mass = mass_of(grains, i);
  double energy = 0.5 * mass * (grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i]);
  if (grains.is_3d) energy += 0.5 * mass * grains.vz[i] * grains.vz[i];
  return energy;
}

/// `as_clump`: turn_as_clumps. Handed down, so that the loop over balls calls nothing.
double energy_of_turning(const Grains& grains, std::size_t i, bool as_clump) {
  if (!grains.rotation) return 0;
  const double inverse_inertia = grains.polydisperse ? grains.inverse_inertia[i] : grains.kinds.front().inverse_inertia;
  if (inverse_inertia <= 0) return 0;
  if (as_clump) {
    const Vector3 spin = spin_of(grains, i);
    return 0.5 * dot(spin, turning_clump(grains, i).momentum_of(spin));
  }
  double spin2 = grains.omega[i] * grains.omega[i];
  if (grains.is_3d) spin2 += grains.omega_x[i] * grains.omega_x[i] + grains.omega_y[i] * grains.omega_y[i];
  return 0.5 * spin2 / inverse_inertia;
}

double energy_of_height(const Grains& grains, std::size_t i, const Eigen::Vector2d& gravity) {
  return -(mass_of(grains, i) * (gravity.x() * grains.x[i] + gravity.y() * grains.y[i]));
}

}  // namespace

double mechanical_energy(const Grains& grains, std::size_t i, const Eigen::Vector2d& gravity) {
  return energy_of_travel(grains, i) + energy_of_turning(grains, i, turn_as_clumps(grains)) +
         energy_of_height(grains, i, gravity);
}

double kinetic_energy(const Grains& grains) {
  const bool as_clumps = turn_as_clumps(grains);
  double energy = 0;
  for (std::size_t i = 0; i < grains.size(); ++i)
    energy += energy_of_travel(grains, i) + energy_of_turning(grains, i, as_clumps);
  return energy;
}

double potential_energy(const Grains& grains, const Eigen::Vector2d& gravity) {
  double energy = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) energy += energy_of_height(grains, i, gravity);
  return energy;
}

namespace {

std::string describe_grain(const Integration& s, std::size_t i) {
  return grain_text(s.model, s.grains, i);
}

double speed2(const Grains& g, std::size_t i) {
  return g.vx[i] * g.vx[i] + g.vy[i] * g.vy[i] + (g.is_3d ? g.vz[i] * g.vz[i] : 0);
}

/// Of a grain towards what it is in, at most, m/s; of a wall any vessel's.
double speed_into(const Integration& s, const DeepestContact& contact) {
  const Grains& g = s.grains;
  const auto velocity = [&g](int k) { return g.velocity(static_cast<std::size_t>(k)); };
  if (contact.partner >= 0) return (velocity(contact.grain) - velocity(contact.partner)).norm();
  double most = 0;
  for (std::size_t v = 0; v < s.model.vessels.size(); ++v) {
    const PoseRate rate = s.field.walls().rate(v, s.state.time);
    const Eigen::Vector3d of_vessel(rate.velocity.x(), rate.velocity.y(), rate.across_velocity);
    most = std::max(most, (velocity(contact.grain) - of_vessel).norm());
  }
  return most;
}

/// The relative overlap that an impact would reach which has come as deep as this with a speed (m/s) left. Overlaps
/// grow as a power of the speed.
double whole_impact(const LawTraits& law, const DeepestContact& contact, double speed) {
  const auto overlap = [&](double v) { return law.impact_overlap(contact.stiffness, contact.inverse_mass, v); };
  const double exponent = portable_math::log(overlap(2) / overlap(1)) / portable_math::log(2);
  const double spent = portable_math::pow(contact.overlap / overlap(1), 1 / exponent);
  return contact.relative_overlap * overlap(portable_math::hypot(spent, speed)) / contact.overlap;
}

/// The first grain whose state is not a number; else the fastest.
std::size_t first_invalid_or_fastest(const Grains& g) {
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!std::isfinite(mechanical_energy(g, i, Eigen::Vector2d::Zero()) + g.place(i).sum())) return i;
    if (speed2(g, i) > speed2(g, fastest)) fastest = i;
  }
  return fastest;
}

/// Two digits, towards zero or away from it: a limit is kept by what is advised.
double rounded(double value, bool up) {
  const double unit = portable_math::pow(10.0, std::floor(portable_math::log(value) / portable_math::log(10)) - 1);
  return unit * (up ? std::ceil(value / unit) : std::floor(value / unit));
}

}  // namespace

Guard::Guard(const Model& model, GuardState& state)
    : model_(model),
      limits_(model.scene.guard),
      law_(*model.law),
      insisted_on_step_(model.step.too_long),
      state_(state) {}

void Guard::stop(std::string reason) {
  if (!state_.stop_reason) state_.stop_reason = std::move(reason);
}

/// The key and value with which an impact that reaches this relative overlap keeps within the warning limit; at rest a
/// contact yields more to stiffness.
std::string Guard::stiff_enough(double relative_overlap, int lot) const {
  const double exponent =
      -portable_math::log(law_.impact_overlap(2, 1, 1) / law_.impact_overlap(1, 1, 1)) / portable_math::log(2);
  const double too_soft = portable_math::pow(relative_overlap / limits_.warn_relative_overlap, 1 / exponent);
  const bool shell = law_.material == LawMaterial::shell;
  const SeedLot& seed = model_.scene.lots[static_cast<std::size_t>(lot)];
  const std::optional<double>& own = shell ? seed.shell_compression : seed.youngs_modulus;
  const Contact& contact = model_.scene.contact;
  const double value = own.value_or(shell ? contact.shell_compression : contact.youngs_modulus);
  const std::string_view key = law_.stiffness_key();
  return fmt::format("{} = {:g}{} would keep such an impact within {:g}",
                     own ? fmt::format("seeds.{}{}", seed.name, key.substr(key.find('.'))) : std::string(key),
                     rounded(shell ? value / too_soft : value * too_soft, !shell), shell ? "" : " Pa",
                     limits_.warn_relative_overlap);
}

std::string Guard::shorter_step(double dt) const {
  return fmt::format("numerics.dt = {:g} s is short enough", rounded(std::min(dt, model_.step.longest_safe), false));
}

void Guard::watch_step(const Integration& s) {
  watch_overlap(s, std::exchange(s.state.statistics.max_relative_overlap, 0));
  if (!s.too_fast) return;
  // Insisted on or not: no list can be made of grains that are nowhere.
  if (!std::isfinite(kinetic_energy(s.grains)))
    stop(fmt::format("the state of {} is not a number at {:.4g} s: {}",
                     describe_grain(s, first_invalid_or_fastest(s.grains)), s.state.time, shorter_step(0.5 * s.dt)));
  else
    watch_stride(s);
}

void Guard::watch_overlap(const Integration& s, double overlap) {
  state_.max_relative_overlap = std::max(state_.max_relative_overlap, overlap);
  if (overlap > limits_.stop_relative_overlap) {
    const DeepestContact deepest = s.field.deepest_contact();
    const std::string other = deepest.partner < 0
                                  ? "a wall"
                                  : fmt::format("grain {}", s.grains.id[static_cast<std::size_t>(deepest.partner)]);
    const std::size_t grain = static_cast<std::size_t>(deepest.grain);
    if (s.state.step == 0)
      return stop(
          fmt::format("the relative overlap is {:.3g} before the first step (guard.stop_relative_overlap = "
                      "{:.3g}): {} was put in {}; no step is too long",
                      overlap, limits_.stop_relative_overlap, describe_grain(s, grain), other));
    const double whole = std::max(overlap, whole_impact(law_, deepest, speed_into(s, deepest)));
    stop(fmt::format(
        "the relative overlap reached {:.3g} at {:.4g} s (guard.stop_relative_overlap = {:.3g}): {} in {}; {}", overlap,
        s.state.time, limits_.stop_relative_overlap, describe_grain(s, grain), other,
        stiff_enough(whole, s.grains.lot[grain])));
  } else if (overlap > limits_.warn_relative_overlap) {
    if (state_.deep_since < 0) state_.deep_since = s.state.time;
    ++state_.let_pass.deep_steps;
  }
}

void Guard::watch_stride(const Integration& s) {
  if (insisted_on_step_) {
    if (state_.strides_since < 0) state_.strides_since = s.state.time;
    ++state_.let_pass.strides;
    return;
  }
  const std::size_t fastest = first_invalid_or_fastest(s.grains);
  const double speed = std::sqrt(speed2(s.grains, fastest));
  stop(fmt::format(
      "{} moves at {:.4g} m/s at {:.4g} s, more than {:.2g} radii in a step, and could pass a wall unseen: {}",
      describe_grain(s, fastest), speed, s.state.time, longest_stride_in_radii,
      shorter_step(0.5 * s.dt * s.fastest / speed)));
}

void Guard::watch_energy(const Integration& s, EnergyAccount& account) {
  account.kinetic = kinetic_energy(s.grains);
  account.potential = potential_energy(s.grains, s.model.gravity);
  account.elastic = s.field.elastic_energy();
  account.wall_work = s.kept.wall_work;
  const double moving = account.kinetic + account.elastic;
  // Places along and up are in the potential energy, those across in none.
  const bool finite_across = std::ranges::all_of(s.grains.z, [](double z) { return std::isfinite(z); });
  if (!std::isfinite(moving + account.potential) || !finite_across) {
    stop(fmt::format("the state of {} is not a number at {:.4g} s: {}",
                     describe_grain(s, first_invalid_or_fastest(s.grains)), s.state.time, shorter_step(0.5 * s.dt)));
    return;
  }
  const double only_falls = moving + account.potential - account.wall_work - account.inserted + account.removed;
  if (!state_.has_energy) {
    state_.has_energy = true;
    state_.lowest = only_falls;
    state_.first_potential = account.potential;
  }
  if (only_falls <= state_.lowest) {
    state_.lowest = only_falls;
    // What coheres holds less than nothing.
    state_.in_play = std::max(state_.in_play, account.kinetic + std::abs(account.elastic));
  }
  account.made_by_numerics = std::max(account.made_by_numerics, only_falls - state_.lowest);
  const double fallen = std::max(0.0, state_.first_potential + account.inserted - account.removed - account.potential);
  const double scale = state_.in_play + fallen + s.kept.gross_wall_work;
  const double made = only_falls - state_.lowest;
  if (made <= 0) return;
  state_.most_made = std::max(state_.most_made, made / scale);
  if (made > limits_.energy_tolerance * scale) {
    const std::size_t fastest = first_invalid_or_fastest(s.grains);
    stop(
        fmt::format("the numerics made {:.3g} J by {:.4g} s, {:.3g} of the energy in play: the step is too long; the "
                    "fastest is {}, {:.4g} m/s; {}",
                    made, s.state.time, made / scale, describe_grain(s, fastest), std::sqrt(speed2(s.grains, fastest)),
                    shorter_step(0.5 * s.dt)));
  } else if (made > energy_warning * scale) {
    if (state_.energy_since < 0) state_.energy_since = s.state.time;
    ++state_.let_pass.energy_accounts;
  }
}

void Guard::watch_lost(const Integration& s, const std::vector<int>& grains) {
  if (limits_.stop_relative_overlap >= 1) return;
  const std::size_t first = static_cast<std::size_t>(grains.front());
  const std::string more = grains.size() == 1 ? "" : fmt::format(" and {} more", grains.size() - 1);
  stop(fmt::format("{}{} went through a wall at {:.4g} s; {}", describe_grain(s, first), more, s.state.time,
                   stiff_enough(std::max(1.0, state_.max_relative_overlap), s.grains.lot[first])));
}

std::vector<std::string> Guard::warnings() const {
  std::vector<std::string> warnings;
  const ToleratedViolations& passed = state_.let_pass;
  const auto steps = [](std::int64_t count) { return fmt::format("{} step{}", count, count == 1 ? "" : "s"); };
  if (passed.deep_steps > 0)
    warnings.push_back(fmt::format(
        "the relative overlap passed {:.3g} at {:.4g} s, in {} in all, and reached {:.3g}: {}; "
        "a {} {} is stiffer",
        limits_.warn_relative_overlap, state_.deep_since, steps(passed.deep_steps), state_.max_relative_overlap,
        law_.material == LawMaterial::shell ? "a thin shell is no longer a good model"
                                            : "Hertz' law is for small overlaps",
        law_.stiffer_value(), law_.stiffness_key()));
  if (passed.strides > 0)
    warnings.push_back(
        fmt::format("a grain moves more than {:.2g} radii in a step at {:.4g} s, in {} in all, and could "
                    "pass a wall unseen",
                    longest_stride_in_radii, state_.strides_since, steps(passed.strides)));
  if (passed.energy_accounts > 0)
    warnings.push_back(fmt::format("the numerics made {:.3g} of the energy in play, more than {:.3g} from {:.4g} s on",
                                   state_.most_made, energy_warning, state_.energy_since));
  return warnings;
}

bool Guard::outside_the_model() const {
  const GuardLimits usual;
  const bool stop_was_raised = limits_.stop_relative_overlap > usual.stop_relative_overlap;
  const double borne = std::min(limits_.warn_relative_overlap, usual.warn_relative_overlap);
  return insisted_on_step_ || (stop_was_raised && state_.max_relative_overlap > borne) ||
         state_.most_made > usual.energy_tolerance;
}

}  // namespace vibrosow
