#include "simulation/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

/// Share of the energy in play that the numerics may make before it is worth a word.
constexpr double energy_warning = 0.05;

}  // namespace

double mechanical_energy(const Grains& grains, std::size_t i, const Eigen::Vector2d& gravity) {
  const GrainKind kind = grains.kind(i);
  double energy = 0.5 * kind.mass * (grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i]);
  if (grains.rotation && kind.inverse_inertia > 0)
    energy += 0.5 * grains.omega[i] * grains.omega[i] / kind.inverse_inertia;
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

Guard::Guard(const Scene& scene, bool insisted_on_step) : limits_(scene.guard), insisted_on_step_(insisted_on_step) {}

void Guard::stop(std::string reason) {
  if (!stop_reason_) stop_reason_ = std::move(reason);
}

void Guard::watch_step(const Integration& s) {
  max_compression_ = std::max(max_compression_, s.statistics.max_compression);
  if (warned_at_ < 0 && max_compression_ > limits_.warn_compression) {
    warned_at_ = s.time;
    warnings_.push_back(
        fmt::format("shell compression passed {:.3g} of the radius at {:.4g} s: a thin shell is no longer a "
                    "good model; a smaller contact.shell_compression is stiffer",
                    limits_.warn_compression, s.time));
  }
  if (max_compression_ > limits_.stop_compression)
    stop(fmt::format("shell compression reached {:.3g} of the radius at {:.4g} s (guard.stop_compression = {:.3g})",
                     max_compression_, s.time, limits_.stop_compression));

  if (!s.too_fast) return;
  // Insisted on or not: no list can be made of grains that are nowhere.
  if (!std::isfinite(kinetic_energy(s.grains)))
    stop(fmt::format("a grain's state is not a number at {:.4g} s", s.time));
  else
    watch_stride(s.time);
}

void Guard::watch_stride(double time) {
  const std::string what =
      fmt::format("a grain moves more than {:.2g} radii in a step at {:.4g} s and could pass a wall unseen",
                  longest_stride_in_radii, time);
  if (!insisted_on_step_) return stop(what + "; a shorter step is needed");
  if (!warned_of_stride_) warnings_.push_back(what);
  warned_of_stride_ = true;
}

void Guard::watch_energy(const Integration& s, EnergyAccount& account) {
  account.kinetic = kinetic_energy(s.grains);
  account.potential = potential_energy(s.grains, s.gravity);
  account.elastic = s.field.elastic_energy(s.grains);
  account.wall_work = s.wall_work;
  const double moving = account.kinetic + account.elastic;
  if (!std::isfinite(moving + account.potential)) {
    stop(fmt::format("a grain's state is not a number at {:.4g} s", s.time));
    return;
  }
  const double only_falls = moving + account.potential - account.wall_work - account.inserted + account.removed;
  if (!has_energy_) {
    has_energy_ = true;
    lowest_ = only_falls;
    first_potential_ = account.potential;
  }
  if (only_falls <= lowest_) {
    lowest_ = only_falls;
    in_play_ = std::max(in_play_, moving);
  }
  account.made_by_numerics = std::max(account.made_by_numerics, only_falls - lowest_);
  const double fallen = std::max(0.0, first_potential_ + account.inserted - account.removed - account.potential);
  const double scale = in_play_ + fallen + s.gross_wall_work;
  const double made = only_falls - lowest_;
  if (made > limits_.energy_tolerance * scale && made > 0)
    stop(fmt::format("the numerics made {:.3g} J by {:.4g} s, {:.3g} of the energy in play: the step is too long", made,
                     s.time, made / scale));
  else if (made > energy_warning * scale && made > 0 && !warned_of_energy_) {
    warned_of_energy_ = true;
    warnings_.push_back(
        fmt::format("the numerics made {:.3g} of the energy in play by {:.4g} s", made / scale, s.time));
  }
}

void Guard::wall_crossed(std::size_t grains, double time) {
  if (limits_.stop_compression < 1)
    stop(fmt::format("{} grain{} went through a wall at {:.4g} s", grains, grains == 1 ? "" : "s", time));
}

std::vector<std::string> Guard::warnings() const {
  return warnings_;
}

bool Guard::outside_the_model() const {
  const bool stop_was_raised = limits_.stop_compression > GuardLimits{}.stop_compression;
  return insisted_on_step_ || (stop_was_raised && max_compression_ > limits_.warn_compression);
}

}  // namespace vibrosow
