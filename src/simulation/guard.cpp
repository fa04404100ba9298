#include "simulation/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "grains/turning_clump.hpp"

namespace vibrosow {
namespace {

/// Share of the energy in play that the numerics may make before it is worth a word.
constexpr double energy_warning = 0.05;

}  // namespace

double mechanical_energy(const Grains& grains, std::size_t i, const Eigen::Vector2d& gravity) {
  const GrainKind kind = grains.kind(i);
  double energy = 0.5 * kind.mass * (grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i]);
  const bool turns = grains.rotation && kind.inverse_inertia > 0;
  if (grains.in_space) energy += 0.5 * kind.mass * grains.vz[i] * grains.vz[i];
  if (turns && turn_as_clumps(grains)) {
    const Eigen::Vector3d spin = spin_of(grains, i);
    energy += 0.5 * spin.dot(TurningClump(grains, i).momentum_of(spin));
  } else if (turns) {
    double spin2 = grains.omega[i] * grains.omega[i];
    if (grains.in_space) spin2 += grains.omega_x[i] * grains.omega_x[i] + grains.omega_y[i] * grains.omega_y[i];
    energy += 0.5 * spin2 / kind.inverse_inertia;
  }
  return energy - kind.mass * (gravity.x() * grains.x[i] + gravity.y() * grains.y[i]);
}

double kinetic_energy(const Grains& grains) {
  double energy = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) energy += mechanical_energy(grains, i, Eigen::Vector2d::Zero());
  return energy;
}

double potential_energy(const Grains& grains, const Eigen::Vector2d& gravity) {
  double energy = 0;
  for (std::size_t i = 0; i < grains.size(); ++i)
    energy -= grains.kind(i).mass * (gravity.x() * grains.x[i] + gravity.y() * grains.y[i]);
  return energy;
}

Guard::Guard(const Model& model, GuardState& state)
    : limits_(model.scene.guard), law_(*model.law), insisted_on_step_(model.step.too_long), state_(state) {}

void Guard::stop(std::string reason) {
  if (!state_.stop_reason) state_.stop_reason = std::move(reason);
}

void Guard::watch_step(const Integration& s) {
  state_.max_relative_overlap = std::max(state_.max_relative_overlap, s.state.statistics.max_relative_overlap);
  if (state_.warned_at < 0 && state_.max_relative_overlap > limits_.warn_relative_overlap) {
    state_.warned_at = s.state.time;
    state_.warnings.push_back(fmt::format("the relative overlap passed {:.3g} at {:.4g} s: {}; a {} {} is stiffer",
                                          limits_.warn_relative_overlap, s.state.time,
                                          law_.material == LawMaterial::shell ? "a thin shell is no longer a good model"
                                                                              : "Hertz' law is for small overlaps",
                                          law_.stiffer_value(), law_.stiffness_key()));
  }
  if (state_.max_relative_overlap > limits_.stop_relative_overlap)
    stop(fmt::format("the relative overlap reached {:.3g} at {:.4g} s (guard.stop_relative_overlap = {:.3g})",
                     state_.max_relative_overlap, s.state.time, limits_.stop_relative_overlap));

  if (!s.too_fast) return;
  // Insisted on or not: no list can be made of grains that are nowhere.
  if (!std::isfinite(kinetic_energy(s.grains)))
    stop(fmt::format("a grain's state is not a number at {:.4g} s", s.state.time));
  else
    watch_stride(s.state.time);
}

void Guard::watch_stride(double time) {
  const std::string what =
      fmt::format("a grain moves more than {:.2g} radii in a step at {:.4g} s and could pass a wall unseen",
                  longest_stride_in_radii, time);
  if (!insisted_on_step_) return stop(what + "; a shorter step is needed");
  if (!state_.warned_of_stride) state_.warnings.push_back(what);
  state_.warned_of_stride = true;
}

void Guard::watch_energy(const Integration& s, EnergyAccount& account) {
  account.kinetic = kinetic_energy(s.grains);
  account.potential = potential_energy(s.grains, s.model.gravity);
  account.elastic = s.field.elastic_energy();
  account.wall_work = s.kept.wall_work;
  const double moving = account.kinetic + account.elastic;
  // Places along and up are in the potential energy, those across in none.
  const double across = std::accumulate(s.grains.z.begin(), s.grains.z.end(), 0.0);
  if (!std::isfinite(moving + account.potential + across)) {
    stop(fmt::format("a grain's state is not a number at {:.4g} s", s.state.time));
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
  if (made > limits_.energy_tolerance * scale && made > 0)
    stop(fmt::format("the numerics made {:.3g} J by {:.4g} s, {:.3g} of the energy in play: the step is too long", made,
                     s.state.time, made / scale));
  else if (made > energy_warning * scale && made > 0 && !state_.warned_of_energy) {
    state_.warned_of_energy = true;
    state_.warnings.push_back(
        fmt::format("the numerics made {:.3g} of the energy in play by {:.4g} s", made / scale, s.state.time));
  }
}

void Guard::wall_crossed(std::size_t grains, double time) {
  if (limits_.stop_relative_overlap < 1)
    stop(fmt::format("{} grain{} went through a wall at {:.4g} s", grains, grains == 1 ? "" : "s", time));
}

std::vector<std::string> Guard::warnings() const {
  return state_.warnings;
}

bool Guard::outside_the_model() const {
  const bool stop_was_raised = limits_.stop_relative_overlap > GuardLimits{}.stop_relative_overlap;
  return insisted_on_step_ || (stop_was_raised && state_.max_relative_overlap > limits_.warn_relative_overlap);
}

}  // namespace vibrosow
